import { App } from '../support/app-page';
import { expect, test } from '../support/fixtures';
import { LayoutWatch } from '../support/layout-shifts';
import { demoSettings, serveDemo } from '../support/made-demo';

/** Of the window's area times its height, from the first navigation on; Web Vitals call 0.1 good. */
const MOST = 0.02;
/** What may go elsewhere in a step: what asked for it, and what it is part of. */
const NOTHING = /^$/;
const OWN_BADGE = /^button\.about /;
const OWN_LIST = /^button\S* .*"(Star|Use) |Frame rate|^button\.flag /;

for (const [width, height] of [
  [1440, 900],
  [1280, 720],
  [390, 844],
] as const)
  test(`nothing jumps at ${width} x ${height}`, async ({ page }) => {
    await page.setViewportSize({ width, height });
    const watch = await LayoutWatch.begin(page);
    const app = new App(page);
    let whole = 0;
    /** Looks at what a step has moved: `may` are the controls that it was about. */
    const looked = async (name: string, may: RegExp): Promise<void> => {
      const shifts = await watch.shifts();
      const jumped = shifts.filter(({ afterInput }) => !afterInput);
      whole += jumped.reduce((sum, { value }) => sum + value, 0);
      expect(whole, `${name}: ${JSON.stringify(jumped, null, 1)}`).toBeLessThan(MOST);
      const moved = (await watch.moved()).filter((control) => !may.test(control));
      expect(moved, name).toEqual([]);
      await watch.mark();
    };
    /** Waits for the measures of the dance that `act` asks for; those of the one before stay until then. */
    const measured = async (act: () => Promise<void>): Promise<void> => {
      await app.until(({ quality }) => quality);
      await page.evaluate('window.measuredBefore = window.reactdance.store.getState().quality');
      await act();
      await app.until(
        ({ job, quality }) => !job && quality && quality !== Reflect.get(window, 'measuredBefore'),
      );
    };

    let release: () => void = () => undefined;
    const held = new Promise<void>((resolve) => (release = resolve));
    await page.route('**/models/tiny/*.onnx', async (route) => {
      await held;
      await route.continue();
    });
    await serveDemo(page, demoSettings);
    await app.openWithoutPicture();
    await app.until(({ demo, reading }) => demo === 'ready' && !reading.song && !reading.leader);
    await looked('the page with its demo', NOTHING);

    release();
    await app.settled();
    await looked('the model has come', OWN_BADGE);

    await page.getByRole('button', { name: 'Play the demo' }).click();
    await app.until(({ playback }) => playback.time > 0.3);
    await page.keyboard.press('Space');
    await looked('playing', NOTHING);

    await measured(() => page.getByRole('slider', { name: 'Coarse guidance' }).fill('2'));
    await looked('another reaction and its quality', OWN_LIST);

    await measured(() => page.getByRole('button', { name: 'Roll a new seed' }).click());
    expect(await app.read(({ takes }) => takes.length)).toBe(3);
    await looked('another take and its quality', OWN_LIST);

    const matrix = page.getByRole('button', { name: /By body part/ });
    await matrix.click();
    await expect(page.getByRole('group', { name: 'Guidance by body part' })).toBeVisible();
    expect(await watch.movedElsewhere(matrix)).toEqual([]);
    await matrix.click();
    await looked('the matrix opened and closed', NOTHING);

    await page.getByRole('button', { name: /^Switch to / }).click();
    await looked('another theme', NOTHING);

    await page.getByRole('button', { name: 'Download', exact: true }).click();
    await looked('the download menu opens', NOTHING);
    await page.keyboard.press('Escape');
    await looked('the download menu closes', NOTHING);

    if (width < 761) return;
    await page
      .getByRole('button', { name: /^Use .* as B$/ })
      .last()
      .click();
    await expect(page.getByRole('radiogroup', { name: 'Compare takes' })).toBeVisible();
    await looked('a comparison', NOTHING);
  });
