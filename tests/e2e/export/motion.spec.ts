import { readFile } from 'node:fs/promises';
import type { Download } from '@playwright/test';
import { unzipSync } from 'fflate';
import { validateBytes } from 'gltf-validator';
import { App } from '../support/app-page';
import { expect, test } from '../support/fixtures';
import { demoSettings as settings, serveDemo } from '../support/made-demo';

const PREFIX = 'made-demo-song_made-demo-leader_demo-reaction_s77_c0.50-f0.25-m1.50_footlock';

test('leader, reactor or both are saved in four formats with their metadata', async ({ page }) => {
  await serveDemo(page, settings, 60);
  const app = new App(page);
  await app.openWithoutPicture();
  await app.settled();
  const menu = page.getByRole('dialog', { name: 'Download' });
  const save = async (format: string): Promise<Download> => {
    const coming = page.waitForEvent('download');
    await menu.getByRole('button', { name: new RegExp(format) }).click();
    const download = await coming;
    // The menu stays for the next format and says what was saved.
    await expect(menu).toContainText(/Saved, [\d.]+ [KM]B/);
    await expect(menu).toContainText(download.suggestedFilename());
    return download;
  };
  const bytes = async (download: Download): Promise<Uint8Array> =>
    new Uint8Array(await readFile(await download.path()));

  await test.step('the dancer is chosen by arrow keys and remembered; the file name follows', async () => {
    await page.keyboard.press('e');
    await expect(menu.getByRole('button', { name: /BVH/ })).toBeFocused();
    await expect(menu).toContainText(`${PREFIX}_reactor.bvh`);
    await menu.getByRole('radio', { name: 'Reactor' }).focus();
    await page.keyboard.press('ArrowRight');
    await expect(menu.getByRole('radio', { name: 'Leader' })).toBeFocused();
    await expect(menu).toContainText('made-demo-song_made-demo-leader_leader.bvh');
    await page.keyboard.press('ArrowRight');
    await expect(menu).toContainText(`${PREFIX}_both-bvh.zip`);
    await expect(menu.getByRole('button', { name: 'Save video' })).toBeDisabled();
    await expect(menu).toContainText('A video needs the 3D view');
  });

  await test.step('GLB: valid, two dancers in one animation', async () => {
    const download = await save('GLB');
    expect(download.suggestedFilename()).toBe(`${PREFIX}_both.glb`);
    const { issues, info } = await validateBytes(await bytes(download));
    expect(issues.messages.filter(({ severity }) => severity < 2)).toEqual([]);
    expect(info).toMatchObject({ animationCount: 1 });
    expect(info.totalTriangleCount).toBeGreaterThan(20_000);
  });

  await test.step('BVH, NPZ and JSON of both', async () => {
    expect(Object.keys(unzipSync(await bytes(await save('BVH'))))).toEqual([
      'made-demo-song_made-demo-leader_leader.bvh',
      `${PREFIX}_reactor.bvh`,
    ]);
    const json = JSON.parse(await readFile(await (await save('JSON')).path(), 'utf8')) as object;
    const model = { id: 'tiny' };
    expect(json).toMatchObject({
      song: 'Made demo song',
      take: 'Demo reaction',
      model,
      settings,
      frames: 60,
    });
    const archive = await bytes(await save('NPZ'));
    const names = Object.keys(unzipSync(archive));
    expect(names).toEqual(['leader.npy', 'reactor.npy', 'fps.npy', 'joints.npy', 'metadata.npy']);
  });

  await test.step('a BVH says in which unit it is, since the file cannot', async () => {
    await expect(menu.getByRole('button', { name: /^BVH/ })).toContainText('centimetres');
    await menu.getByRole('radio', { name: 'Reactor' }).click();
    await expect(menu.getByRole('button', { name: /^BVH/ })).toContainText('centimetres');
    await menu.getByRole('radio', { name: 'Both' }).click();
  });

  await test.step('with another frame rate, which the name says', async () => {
    await menu.getByRole('radio', { name: '24', exact: true }).click();
    const download = await save('JSON');
    expect(download.suggestedFilename()).toBe(`${PREFIX}_both_24fps.json`);
    expect(JSON.parse(await readFile(await download.path(), 'utf8'))).toMatchObject({ fps: 24, frames: 48 });
    await menu.getByRole('radio', { name: '30', exact: true }).click();
    await save('NPZ');
  });

  await test.step('the loop alone, which the name says', async () => {
    await expect(menu).toContainText('For a part, drag a loop on the ruler');
    await page.keyboard.press('Escape');
    const region = await app.drawLoop(15, 45);
    await page.keyboard.press('e');
    await menu.getByRole('radio', { name: 'Loop' }).click();
    const download = await save('JSON');
    expect(download.suggestedFilename()).toMatch(/_footlock_\d\.\d-\d\.\ds_both\.json$/);
    const { frames, shift } = JSON.parse(await readFile(await download.path(), 'utf8')) as Record<
      string,
      number
    >;
    expect([frames, shift]).toEqual([
      Math.round((region.to - region.from) * 30),
      -Math.round(region.from * 30),
    ]);
    expect(frames).toBeLessThan(60);
    await menu.getByRole('radio', { name: 'Whole dance' }).click();
    await save('NPZ');
  });

  await test.step('the last format has the focus when the menu opens again', async () => {
    await page.keyboard.press('Escape');
    await expect(menu).toBeHidden();
    await page.keyboard.press('e');
    await expect(menu.getByRole('button', { name: /NPZ/ })).toBeFocused();
    await expect(menu.getByRole('radio', { name: 'Both' })).toBeChecked();
  });

  await test.step('of a file of both the bar says which dancer was read, and that there is another', async () => {
    const buffer = Buffer.from(await bytes(await save('NPZ')));
    await page.keyboard.press('Escape');
    await app.chooseLeader({ name: 'both.npz', mimeType: '', buffer });
    await expect(page.getByRole('button', { name: /^Leader: both\.npz .*leader \(1 of 2\)/ })).toBeVisible();
  });
});
