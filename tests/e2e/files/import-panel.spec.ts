/** The panel in which the joints of a file are set by hand, and the leaders that need no file. */
import { App } from '../support/app-page';
import { bvhText, type TestFile } from '../support/files';
import { expect, test } from '../support/fixtures';

test.use({ viewport: { width: 1280, height: 800 } });

/** Bones whose names say nothing; the arms are too unlike to be found by the shape of the body. */
const NAMES: readonly (readonly [name: string, written: string])[] = [
  ['Hips', 'k0'],
  ...['Left', 'Right'].flatMap((side, i): [string, string][] =>
    ['UpLeg', 'Leg', 'Foot', 'ToeBase', 'Shoulder', 'Arm', 'ForeArm', 'Hand'].map((part, j) => [
      `${side}${part}`,
      `${'ab'[i]!}${j}`,
    ]),
  ),
  ['Neck', 'k1'],
  ['Head', 'k2'],
];

function unknown(name: string): TestFile {
  let text = bvhText({ frames: 60 });
  for (const [from, to] of NAMES) text = text.replace(new RegExp(`\\b${from}\\b`), to);
  return { name, mimeType: '', buffer: Buffer.from(text.replace('OFFSET 27 0 0', 'OFFSET 12 0 0')) };
}

/** The joints of the file for some of ours. */
const CHOICES = {
  'left hip': 'a0',
  'left knee': 'a1',
  'left ankle': 'a2',
  'left foot': 'a3',
  'left collar': 'a4',
  'left shoulder': 'a5',
  'left elbow': 'a6',
  'left wrist': 'a7',
  'right hip': 'b0',
  'right knee': 'b1',
  'right ankle': 'b2',
  'right foot': 'b3',
  'right collar': 'b4',
  'right shoulder': 'b5',
  'right elbow': 'b6',
  'right wrist': 'b7',
  neck: 'k1',
  head: 'k2',
};

test('joints of a refused file are chosen, exchanged, remembered and forgotten', async ({ page }) => {
  const app = new App(page);
  await app.openWithoutPicture();
  await app.settled();
  const panel = page.getByRole('dialog', { name: 'Joints and units' });
  const openPanel = (): Promise<void> =>
    page.getByRole('button', { name: 'Joints and units' }).first().click();
  const mapped = (): Promise<[string, string | null, string | null] | null> =>
    app.read(({ leader }) => {
      if (!leader) return null;
      const { mappedBy, joints } = leader.file.report;
      return [mappedBy, joints.left_knee, joints.right_wrist];
    });

  await app.chooseLeader(unknown('unknown.bvh'));
  await expect(app.alert).toHaveAttribute('data-code', 'missing-joints');
  await app.alert.getByRole('button', { name: 'Joints and units' }).click();
  for (const [joint, name] of Object.entries(CHOICES))
    await panel.getByRole('combobox', { name: joint, exact: true }).selectOption({ label: name });
  await panel.getByRole('button', { name: 'Read again' }).click();
  await app.until(({ leader }) => leader?.name === 'unknown.bvh');
  await expect(panel).toBeHidden();
  expect(await mapped()).toEqual(['hand', 'a1', 'b7']);

  await openPanel();
  const knee = panel.getByRole('combobox', { name: 'left knee', exact: true });
  await expect(knee.locator('option:checked')).toHaveText('a1');
  await panel.getByRole('button', { name: 'Exchange left and right' }).click();
  await expect(knee.locator('option:checked')).toHaveText('b1');
  await panel.getByRole('button', { name: 'Read again' }).click();
  await app.until(({ leader }) => leader?.file.report.joints.left_knee === 'b1');
  await expect(page.getByRole('list', { name: 'Notes' })).toContainText('The feet point backwards');

  await openPanel();
  await panel.getByRole('button', { name: 'Close' }).click();
  await expect(panel).toBeHidden();
  await expect(page.getByRole('button', { name: 'Joints and units' })).toBeFocused();

  // It is for the leader that it was opened for.
  await openPanel();
  await app.drop(unknown('newer.bvh'));
  await app.until(({ leader }) => leader?.name === 'newer.bvh');
  await expect(panel).toBeHidden();

  // Another visit, another file of the same skeleton.
  await app.openWithoutPicture();
  await app.settled();
  await app.chooseLeader(unknown('again.bvh'));
  await app.until(({ leader }) => leader?.name === 'again.bvh');
  expect(await mapped()).toEqual(['hand', 'b1', 'a7']);

  await openPanel();
  await panel.getByRole('button', { name: 'As found' }).click();
  await expect(app.alert).toHaveAttribute('data-code', 'missing-joints');
  expect(await app.read(({ leader }) => leader?.name)).toBe('again.bvh');

  await app.alert.getByRole('button', { name: 'Keep again.bvh' }).click();
  expect(await app.read(({ refusedLeader }) => refusedLeader)).toBeNull();
});

test('a number that cannot be used is not taken for none', async ({ page }) => {
  const app = new App(page);
  await app.openWithoutPicture();
  await app.settled();
  await app.drop({ name: 'dance.bvh', mimeType: '', buffer: Buffer.from(bvhText({ frames: 60 })) });
  await app.reaction('dance.bvh');
  await page.getByRole('button', { name: 'Joints and units' }).first().click();
  const panel = page.getByRole('dialog', { name: 'Joints and units' });
  const rate = panel.getByRole('spinbutton', { name: 'Frames per second' });
  const again = panel.getByRole('button', { name: 'Read again' });
  for (const unusable of ['2e', '5000']) {
    await rate.fill('');
    await rate.pressSequentially(unusable);
    await again.click();
    await expect(rate).toBeFocused();
    await expect(panel).toBeVisible();
  }
  // Of films, with more decimals than two.
  await rate.fill('23.976');
  await again.click();
  await app.until(({ leader }) => leader?.options.fps === 23.976);
  await expect(panel).toBeHidden();
  const inReport = page.getByRole('combobox', { name: 'Frame rate of the leader file' });
  await expect(inReport.locator('option:checked')).toHaveText('23.98 fps');
});

test('a leader of the page needs no file, on the first visit and later', async ({ page }) => {
  const app = new App(page);
  await app.openWithoutPicture();
  await app.settled();
  await page.getByRole('button', { name: 'Slow', exact: true }).click();
  await app.reaction('Slow.bvh');
  await expect(page.getByRole('region', { name: 'Start' })).toBeHidden();
  expect(await app.read(({ leader }) => leader?.file.report.warnings)).toEqual([]);
  await page.getByRole('combobox', { name: 'Take one of our leaders' }).selectOption('Playful');
  await app.reaction('Playful.bvh');

  await page.route('**/leaders/quick.bvh', (route) => route.fulfill({ status: 404 }));
  await page.getByRole('combobox', { name: 'Take one of our leaders' }).selectOption('Quick');
  await expect(app.alert.getByRole('heading')).toHaveText(/“Quick” could not be loaded/);
  expect(await app.read(({ leader }) => leader?.name)).toBe('Playful.bvh');
});
