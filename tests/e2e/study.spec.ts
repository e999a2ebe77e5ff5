/** The blind test: from the choice of dances to the saved answers, by keyboard. */
import { readFileSync } from 'node:fs';
import { AxeBuilder } from '@axe-core/playwright';
import type { Page } from '@playwright/test';
import { TINY } from './support/app-page';
import { bvhText, type TestFile, wav } from './support/files';
import { expect, test } from './support/fixtures';

// Among the dances of the page is the demo's.
test.use({ viewport: { width: 1200, height: 760 }, shippedDemo: true });

const STUDY = TINY.replace('?', '?study&');

const motion = (name: string, sway: number): TestFile => ({
  name,
  mimeType: '',
  buffer: Buffer.from(bvhText({ frames: 90, sway })),
});
const FILES = [
  motion('walk_leader.bvh', 1),
  motion('walk_ours.bvh', 0.5),
  motion('walk_edge.bvh', 2),
  { ...wav({ seconds: 3 }), name: 'walk.wav' },
  motion('turn_leader.bvh', 1.2),
  motion('turn_ours.bvh', 0.4),
  motion('turn_edge.bvh', 2.2),
];

/** What axe finds on the page. */
async function violations(page: Page): Promise<string[]> {
  const { violations: found } = await new AxeBuilder({ page }).analyze();
  return found.map(({ id, nodes }) => `${id}: ${nodes.map(({ html }) => html.slice(0, 160)).join(' | ')}`);
}

/** As on a machine without WebGL, which is faster. */
async function withoutPicture(page: Page): Promise<void> {
  await page.addInitScript(() => {
    Reflect.set(HTMLCanvasElement.prototype, 'getContext', () => null);
  });
}

async function saved(page: Page, button: string): Promise<string> {
  const coming = page.waitForEvent('download');
  await page.getByRole('button', { name: button }).click();
  return readFileSync(await (await coming).path(), 'utf8');
}

test('files are compared by keyboard, a reload loses nothing, and the answers come as tables', async ({
  page,
}) => {
  await withoutPicture(page);
  await page.goto(STUDY);
  const setup = page.getByRole('region', { name: 'Setup' });
  const [chooser] = await Promise.all([
    page.waitForEvent('filechooser'),
    setup.getByRole('button', { name: 'Choose files' }).click(),
  ]);
  await chooser.setFiles(FILES);
  await expect(setup.getByRole('status')).toHaveText(/Your files: 2 leaders, 2 methods, some without music/);
  expect(await violations(page), 'setup').toEqual([]);
  await setup.getByLabel('Participant').fill('Ana');
  await page.keyboard.press('Enter');

  const questions = page.getByRole('region', { name: 'Questions' });
  await expect(questions.getByRole('heading')).toHaveText('Pair 1 of 2');
  await expect(questions.getByRole('button', { name: /Play|Pause/ })).toBeEnabled();
  const asked = await questions.getByRole('group').count();
  expect(await violations(page), 'a pair').toEqual([]);
  // The method that made a partner is nowhere on the page.
  expect(await page.locator('body').innerText()).not.toMatch(/ours|edge/);
  // A key that is held answers one question.
  await page.keyboard.down('1');
  await page.keyboard.down('1');
  await page.keyboard.up('1');
  await expect(questions.getByRole('radio', { checked: true })).toHaveCount(1);
  for (const key of asked === 3 ? '53' : '5') await page.keyboard.press(key);
  await page.keyboard.press('Enter');
  await expect(questions.getByRole('heading')).toHaveText('Pair 2 of 2');

  // The tab is closed in the middle.
  await page.goto(STUDY);
  await expect(setup).toContainText('The test of Ana is not finished: 1 of 2 pairs.');
  await setup.locator('input[type="file"]').first().setInputFiles(FILES);
  await setup.getByRole('button', { name: 'Continue' }).click();
  await expect(questions.getByRole('heading')).toHaveText('Pair 2 of 2');
  await questions.getByRole('radio', { name: 'A a little' }).first().check();
  for (const key of asked === 3 ? '5' : '55') await page.keyboard.press(key);
  await questions.getByRole('button', { name: 'Finish' }).click();

  const result = page.getByRole('region', { name: 'Result' });
  await expect(result.getByRole('row')).toHaveCount(2);
  await expect(result.getByRole('rowheader')).toHaveText('ours over edge');
  const summary = (await saved(page, 'Save summary (CSV)')).trim().split('\r\n');
  expect(summary).toHaveLength(1 + 3);
  expect(summary[1]).toMatch(/^ours,edge,naturalness,2,/);

  // The next participant takes nothing away from the one before.
  await result.getByRole('button', { name: 'Next participant' }).click();
  await expect(setup).toContainText('The answers of Ana are not saved yet.');
  const start = setup.getByRole('button', { name: 'Start', exact: true });
  await start.click();
  await expect(setup).toContainText('A new test replaces the answers of Ana, which are not saved yet.');
  const table = await saved(page, 'Save answers (CSV)');
  const answers = table.trim().split('\r\n');
  expect(answers).toHaveLength(1 + 5);
  expect(answers[1]).toMatch(/^Ana,files,\d+,1,(walk|turn),(ours,edge|edge,ours),naturalness,-2,/);
  await expect(setup).not.toContainText('Ana');
  await start.click();
  await expect(questions.getByRole('heading')).toHaveText('Pair 1 of 2');

  // The same file twice is one participant.
  await page.goto(STUDY);
  const file = (name: string): TestFile => ({ name, mimeType: 'text/csv', buffer: Buffer.from(table) });
  await setup.locator('input[accept=".csv"]').setInputFiles([file('a.csv'), file('b.csv')]);
  await expect(result).toContainText('5 answers of 1 participant.');
  await expect(result).toContainText('5 more were there twice and count once.');
  expect(await saved(page, 'Save answers (CSV)')).toBe(table);
});

test('the dances of the page are shown without a file, also after a first failure', async ({ page }) => {
  await page.route('**/*.bvh', (route) => route.abort());
  await page.goto(STUDY);
  await page.getByRole('button', { name: 'Dances of this page' }).click();
  await page.getByLabel('Pairs, at most').fill('2');
  await page.getByLabel('Seed for the order').fill('3');
  await page.getByRole('button', { name: 'Start' }).click();
  const questions = page.getByRole('region', { name: 'Questions' });
  await expect(questions.getByRole('slider', { name: 'Time' })).toHaveValue('0');
  const again = questions.getByRole('button', { name: 'Try again' });
  await expect(again).toBeVisible({ timeout: 60_000 });
  // What was not seen is not answered.
  await page.keyboard.press('1');
  await expect(questions.getByRole('radio').first()).toBeDisabled();
  await expect(questions.getByRole('radio', { checked: true })).toHaveCount(0);
  await page.unroute('**/*.bvh');
  await again.click();
  const play = questions.getByRole('button', { name: 'Pause' });
  await expect(play).toBeEnabled({ timeout: 60_000 });
  const time = (): Promise<number> =>
    questions.getByRole('slider', { name: 'Time' }).inputValue().then(Number);
  await expect.poll(time).toBeGreaterThan(0.3);
  await play.click();
  const stopped = await time();
  expect(await time()).toBeCloseTo(stopped, 1);
});

test('a test that has begun goes on when files are read that were chosen before it', async ({ page }) => {
  await withoutPicture(page);
  let release = (): void => undefined;
  const held = new Promise<void>((resolve) => (release = resolve));
  await page.route('**/assets/worker-*.js', async (route) => {
    await held;
    await route.continue();
  });
  await page.goto(STUDY);
  const setup = page.getByRole('region', { name: 'Setup' });
  await setup.locator('input[type="file"]').first().setInputFiles(FILES.slice(0, 4));
  await setup.getByRole('button', { name: 'Dances of this page' }).click();
  await expect(setup.getByRole('status')).toHaveText(/The dances of this page/);
  await setup.getByRole('button', { name: 'Start' }).click();
  const questions = page.getByRole('region', { name: 'Questions' });
  await expect(questions.getByRole('status')).toBeVisible();
  // The files are small, and a pair is made of a whole song and several dances.
  release();
  await expect(questions.getByRole('button', { name: /Play|Pause/ })).toBeEnabled({ timeout: 60_000 });
});

test('the time of an answer counts from the first showing of its pair, also after going back', async ({
  page,
}) => {
  await withoutPicture(page);
  await page.addInitScript(() => {
    const now = performance.now.bind(performance);
    Object.assign(window, { later: 0 });
    performance.now = () => now() + (Reflect.get(window, 'later') as number);
  });
  await page.goto(STUDY);
  const setup = page.getByRole('region', { name: 'Setup' });
  await setup.locator('input[type="file"]').first().setInputFiles(FILES);
  await setup.getByRole('button', { name: 'Start' }).click();
  const questions = page.getByRole('region', { name: 'Questions' });
  await expect(questions.getByRole('button', { name: /Play|Pause/ })).toBeEnabled();
  const asked = await questions.getByRole('group').count();
  for (const key of '333'.slice(0, asked)) await page.keyboard.press(key);
  await page.keyboard.press('Enter');
  await expect(questions.getByRole('heading')).toHaveText('Pair 2 of 2');
  await page.evaluate('window.later = 100_000');
  await questions.getByRole('button', { name: 'Back' }).click();
  await expect(questions.getByRole('heading')).toHaveText('Pair 1 of 2');
  await questions.getByRole('radio', { name: 'B clearly' }).first().check();
  await questions.getByRole('button', { name: 'Next pair' }).click();
  for (const key of '333'.slice(0, 5 - asked)) await page.keyboard.press(key);
  await questions.getByRole('button', { name: 'Finish' }).click();
  const answers = (await saved(page, 'Save answers (CSV)')).trim().split('\r\n');
  const changed = answers.find((line) => line.includes(',1,') && line.includes(',naturalness,2,'));
  expect(Number(changed?.split(',').at(-1))).toBeGreaterThan(100);
});

test('playback that stops by itself is said, and goes on with a click', async ({ page }) => {
  await withoutPicture(page);
  await page.goto(STUDY);
  const setup = page.getByRole('region', { name: 'Setup' });
  await setup.locator('input[type="file"]').first().setInputFiles(FILES.slice(0, 4));
  await setup.getByRole('button', { name: 'Start' }).click();
  const questions = page.getByRole('region', { name: 'Questions' });
  const time = questions.getByRole('slider', { name: 'Time' });
  await expect(questions.getByRole('button', { name: 'Pause' })).toBeEnabled();
  // The next round of the song is refused.
  await page.evaluate(() => {
    const { prototype } = HTMLMediaElement;
    const play: unknown = Reflect.get(prototype, 'play');
    Object.assign(prototype, { play: () => Promise.reject(new DOMException('no', 'NotAllowedError')) });
    Object.assign(window, { allow: () => Object.assign(prototype, { play }) });
  });
  const alert = page.getByRole('alert');
  await expect(alert).toContainText('The browser did not start the sound.');
  const play = questions.getByRole('button', { name: 'Play' });
  await play.click();
  await expect(play).toBeVisible();
  await expect(alert).toBeVisible();
  await page.evaluate('window.allow()');
  await play.click();
  await expect(alert).toBeHidden();
  const stood = await time.inputValue();
  await expect(time).not.toHaveValue(stood);
});
