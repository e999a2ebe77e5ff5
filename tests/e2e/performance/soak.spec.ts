/**
 * The page used for long: memory beyond that of songs, leaders, takes and steps of undo stays as it is. SOAK_MINUTES=60
 * goes on for an hour, with at least 200 generations and 60 loads, after the list of takes and the steps of undo are
 * full, so that all memory stays as it is; docs/performance.md has its table.
 */
import { App } from '../support/app-page';
import { bvh, wav } from '../support/files';
import { expect, test } from '../support/fixtures';
import { type Memory, MemoryMeter } from '../support/memory';

const MINUTES = Number(process.env['SOAK_MINUTES'] ?? 0);
/** In a long run as many as fill the list of takes and the steps of undo. */
const WARM_UP = MINUTES > 0 ? { generations: 40, loads: 40 } : { generations: 4, loads: 4 };
/** What is done after it, and how often memory is measured meanwhile. */
const REST =
  MINUTES > 0 ? { generations: 200, loads: 60, parts: 4 } : { generations: 10, loads: 14, parts: 1 };

/** Most that may be added after the warm-up, megabytes; what is held may grow until lists and undo are full. */
const MORE: Memory = {
  heap: 1,
  held: MINUTES > 0 ? 3 : 10,
  buffers: 1,
  elements: 1,
  workers: 2,
  process: 60,
};

test.use({ viewport: { width: 800, height: 600 } });
test.setTimeout((MINUTES + 10) * 60_000);

test('memory stays flat over generations and loads', async ({ page, browser }) => {
  const meter = await MemoryMeter.open(page, browser);
  const app = new App(page);
  await app.openWithoutPicture();
  await app.settled();

  let generations = 0;
  let loads = 0;
  const generate = async (): Promise<void> => {
    const value = ((++generations * 37) % 97) / 100;
    const fader = generations % 3 === 0 ? 'Coarse guidance' : 'Fine guidance';
    await page.getByRole('slider', { name: fader }).fill(String(value));
    if (generations % 4 === 0) await page.getByRole('button', { name: 'Generate' }).click();
    await app.until(({ reaction, settings, job, quality }) => {
      const made = JSON.stringify(reaction?.inputs.settings.guidance);
      return quality && !job && made === JSON.stringify(settings?.guidance);
    });
  };
  const load = async (): Promise<void> => {
    const name = `leader ${++loads}.bvh`;
    await app.drop(
      bvh({ frames: 90, name, sway: 1 + (loads % 50) / 100 }),
      wav({ seconds: 2, bpm: 90 + (loads % 60), name: `song ${loads}.wav` }),
    );
    await app.until(
      ({ reaction, reading, job, quality }, leader) =>
        quality && !job && !reading.song && !reading.leader && reaction?.inputs.leader.name === leader,
      name,
    );
  };
  const rows: (readonly [string, Memory])[] = [];
  const note = async (): Promise<void> => {
    rows.push([`${generations} generations, ${loads} loads`, await meter.measure()]);
  };
  /** Generations and loads, evenly mixed. */
  const work = async (more: { readonly generations: number; readonly loads: number }): Promise<void> => {
    const [madeBefore, loadedBefore] = [generations, loads];
    for (;;) {
      const [made, loaded] = [generations - madeBefore, loads - loadedBefore];
      if (made >= more.generations && loaded >= more.loads) return;
      await (loaded * more.generations <= made * more.loads && loaded < more.loads ? load() : generate());
    }
  };

  await note();
  await work(WARM_UP);
  await note();
  const end = Date.now() + MINUTES * 60_000;
  const part = { generations: REST.generations / REST.parts, loads: REST.loads / REST.parts };
  for (let parts = 0; parts < REST.parts || Date.now() < end; parts++) {
    await work(part);
    await note();
  }

  test.info().annotations.push({ type: 'measured', description: table(rows) });
  if (MINUTES > 0) console.log(table(rows));
  const warm = rows[1]![1];
  const last = rows.at(-1)![1];
  for (const kind of Object.keys(MORE) as (keyof Memory)[])
    expect(last[kind] - warm[kind], `${kind}, megabytes added\n${table(rows)}`).toBeLessThan(MORE[kind]);
  const takes = await app.read(({ takes }) => takes.length);
  if (MINUTES > 0) expect(takes).toBe(40);
  else expect(takes).toBeGreaterThan(WARM_UP.loads + REST.loads);
  expect(await app.read(({ problem }) => problem)).toBeNull();
});

/** In Markdown, megabytes. */
function table(rows: readonly (readonly [string, Memory])[]): string {
  const parts = ['heap', 'held', 'buffers', 'elements', 'workers', 'process'] as const;
  const lines = [
    ['MB after', ...parts],
    ['---', ...parts.map(() => '---:')],
    ...rows.map(([name, memory]) => [name, ...parts.map((part) => memory[part].toFixed(1))]),
  ];
  return lines.map((cells) => `| ${cells.join(' | ')} |`).join('\n');
}
