/** A newer version put on the server while a tab is open never breaks that tab. */
import { App } from '../support/app-page';
import { deployOtherVersion } from '../support/deploy';
import { bvh, wav } from '../support/files';
import { expect } from '../support/fixtures';
import { test } from '../support/host';

test.describe('without a service worker', () => {
  test.use({ serviceWorkers: 'block' });

  test('a tab says that a newer version is out, and goes on with it after a reload', async ({
    page,
    host,
  }) => {
    // As where the browser has thrown away what it had cached.
    host.storesNothing = true;
    const app = new App(page);
    await app.openWithoutPicture();
    await app.settled();
    await app.chooseLeader(bvh({ frames: 60, name: 'kept.bvh' }));
    await app.reaction('kept.bvh');
    await deployOtherVersion(host.root);

    const told = async (): Promise<void> => {
      await expect(app.alert.getByRole('heading')).toHaveText(/^A newer version of this page is out/);
      await expect(app.alert).toContainText('takes and settings stay');
      await page.keyboard.press('Escape');
      await expect(app.alert).toBeHidden();
    };
    await app.chooseLeader(bvh({ frames: 90, name: 'other.bvh' }));
    await told();
    await app.chooseSong(wav({ seconds: 2 }));
    await told();
    await page.getByRole('button', { name: 'Download', exact: true }).click();
    await page.getByRole('button', { name: /GLB/ }).click();
    await told();
    // The dialog of the download is over the panel.
    await page.keyboard.press('Escape');
    // The model itself goes on until it has to be started again.
    await page.getByRole('slider', { name: 'Fine guidance' }).fill('1');
    await app.until(
      ({ reaction, job }) => reaction?.inputs.settings.guidance['upper']?.['fine'] === 1 && !job,
    );
    const worker = page.workers().find((one) => /worker/.test(one.url()));
    await worker?.evaluate('setTimeout(() => { throw new Error("out of luck"); })');
    await page.getByRole('button', { name: 'Generate' }).click();
    await told();
    await page.getByRole('button', { name: 'Generate' }).click();
    await Promise.all([page.waitForEvent('load'), app.alert.getByRole('button', { name: 'Reload' }).click()]);
    await app.until(({ model, leader, takes }) => model.phase === 'ready' && leader && takes.length > 0);
    expect(await app.read(({ leader }) => leader?.name)).toBe('kept.bvh');
    await app.chooseLeader(bvh({ frames: 90, name: 'after.bvh' }));
    await app.reaction('after.bvh');
  });
});

test('a tab with a service worker goes on with its own version', async ({ page, host }) => {
  const app = new App(page);
  await app.openWithoutPicture();
  await app.settled();
  await page.evaluate(async () => void (await navigator.serviceWorker.ready));
  await page.evaluate('caches.delete("reactdance-model")');
  await deployOtherVersion(host.root);
  await app.chooseLeader(bvh({ frames: 60, name: 'later.bvh' }));
  await app.chooseSong(wav({ seconds: 2, name: 'later.wav' }));
  await app.reaction('later.bvh');
  await app.until(({ song, job }) => song?.name === 'later.wav' && !job);
});
