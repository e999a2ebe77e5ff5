/**
 * The page used for long: memory beyond that of songs, leaders, takes and steps of undo stays as it is. SOAK_MINUTES=60
 * goes on for an hour, with at least 200 generations and 60 loads, after the list of takes and the steps of undo are
 * full, so that all memory stays as it is; writes soak.json and docs/soak.svg.
 */
import { writeFileSync } from 'node:fs';
import path from 'node:path';
import { plot } from '../../../tools/bench/plot.mjs';
import { root } from '../../../tools/run.mjs';
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

/**
 * Most that may be added after the warm-up, megabytes; what is held and the rows of takes may grow until lists and undo
 * are full, objects until all that is called often is compiled. The browser's process fills its caches in the first
 * five minutes.
 */
const MORE: Memory = {
  heap: MINUTES > 0 ? 2 : 1,
  held: MINUTES > 0 ? 3 : 10,
  buffers: 1,
  elements: MINUTES > 0 ? 1 : 2,
  workers: 2,
  process: 30,
  browser: MINUTES > 0 ? 40 : 30,
};

const FADERS = ['Coarse guidance', 'Fine guidance', 'Music guidance', 'Variety'];

test.use({ viewport: { width: 800, height: 600 } });
test.setTimeout((2 * MINUTES + 10) * 60_000);

/** Memory after so much use. */
interface Row {
  readonly minutes: number;
  readonly generations: number;
  readonly loads: number;
  readonly memory: Memory;
}

test('memory stays flat over generations and loads, and takes stay as they are', async ({
  page,
  browser,
}) => {
  const meter = await MemoryMeter.open(page, browser);
  const app = new App(page);
  await app.openWithoutPicture();
  await app.settled();

  let generations = 0;
  let loads = 0;
  /** After one of the faders has been moved, or the seed was changed. */
  const generate = async (): Promise<void> => {
    generations++;
    if (generations % 5 === 0)
      await page.getByRole('button', { name: 'New random seed', exact: true }).click();
    else {
      const [fader, step] = [generations % 4, (generations * 7) % 15];
      const slider = page.getByRole('slider', { name: FADERS[fader]!, exact: true });
      await slider.fill(String(((FADERS[fader] === 'Music guidance' ? 10 : 1) * step) / 20));
    }
    await app.until(
      ({ reaction, settings, job, quality }) =>
        quality && !job && JSON.stringify(reaction?.inputs.settings) === JSON.stringify(settings),
    );
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
  /** All takes, each with a sum of its motion. */
  const takes = (): Promise<readonly (readonly unknown[])[]> =>
    app.read(({ takes }) =>
      takes.map(({ id, starred, reaction: { inputs, motion } }) => [
        id,
        starred,
        inputs.leader.name,
        motion.rotations.reduce((sum, value, i) => sum + value * (i % 1009), 0),
      ]),
    );
  const rows: Row[] = [];
  const start = Date.now();
  const note = async (): Promise<void> => {
    const memory = await meter.measure();
    rows.push({ minutes: (Date.now() - start) / 60_000, generations, loads, memory });
    if (MINUTES > 0) writeFileSync(path.join(root, 'soak.json'), JSON.stringify(rows));
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
  await work({ generations: 1, loads: 1 });
  await page
    .getByRole('button', { name: /^Star / })
    .first()
    .click();
  const [starred = []] = await takes();
  await work(WARM_UP);
  await note();
  const end = Date.now() + MINUTES * 60_000;
  const part = { generations: REST.generations / REST.parts, loads: REST.loads / REST.parts };
  for (let parts = 0; parts < REST.parts || Date.now() < end; parts++) {
    await work(part);
    await note();
  }

  test.info().annotations.push({ type: 'measured', description: table(rows) });
  if (MINUTES > 0) {
    console.log(table(rows));
    writeFileSync(path.join(root, 'docs/soak.svg'), plotOf(rows));
  }
  const made = await takes();
  if (MINUTES > 0) expect(made).toHaveLength(40);
  else expect(made.length).toBeGreaterThan(WARM_UP.loads + REST.loads);
  expect(made).toContainEqual(starred);
  expect(await app.read(({ problem }) => problem)).toBeNull();
  await app.until(({ autosave }) => autosave === 'stored');
  await page.reload();
  await app.until(({ takes }, number) => takes.length === number, made.length);
  expect(await takes()).toEqual(made);

  const warm = rows[1]!.memory;
  const last = rows.at(-1)!.memory;
  for (const kind of Object.keys(MORE) as (keyof Memory)[])
    expect(last[kind] - warm[kind], `${kind}, megabytes added\n${table(rows)}`).toBeLessThan(MORE[kind]);
});

/** In Markdown, megabytes. */
function table(rows: readonly Row[]): string {
  const parts = Object.keys(MORE) as (keyof Memory)[];
  const lines = [
    ['minutes', 'generations', 'loads', ...parts],
    ['---:', '---:', '---:', ...parts.map(() => '---:')],
    ...rows.map(({ minutes, generations, loads, memory }) => [
      minutes.toFixed(1),
      generations,
      loads,
      ...parts.map((part) => memory[part].toFixed(1)),
    ]),
  ];
  return lines.map((cells) => `| ${cells.join(' | ')} |`).join('\n');
}

/** Memory over time. */
function plotOf(rows: readonly Row[]): string {
  const line = (name: string, part: keyof Memory) => ({
    name,
    points: rows.map(({ minutes, memory }) => [minutes, memory[part]] as const),
  });
  const ticks = [0, 15, 30, 45, 60].filter((at) => at <= MINUTES).map((at) => ({ at, text: `${at} min` }));
  return plot([
    {
      title: 'processes, MB',
      ticks,
      lines: [line('pages', 'process'), line('browser', 'browser')],
    },
    {
      title: 'objects and buffers, MB',
      ticks,
      lines: [
        line('workers with WebAssembly', 'workers'),
        line('objects', 'heap'),
        line('takes and undo', 'held'),
        line('elements', 'elements'),
        line('other buffers', 'buffers'),
      ],
    },
  ]);
}
