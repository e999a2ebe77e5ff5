import { App } from '../support/app-page';
import { expect, test } from '../support/fixtures';
import { LayoutMonitor } from '../support/layout-shifts';
import { demoSettings, serveDemo } from '../support/made-demo';

/** Largest sum of layout shifts (share of the window that moved times how far); Web Vitals call 0.1 good. */
const MAX_LAYOUT_SHIFT = 0.02;
/** Controls that may move in a step, by their descriptions. */
const NOTHING = /^$/;
const OWN_BADGE = /^button\.about /;
const OWN_LIST = /^button\S* .*"(Star|Use) |Frame rate|^button\.flag /;

for (const [width, height] of [
  [1440, 900],
  [1280, 720],
  [390, 844],
] as const)
  test(`the layout is stable at ${width} x ${height}`, async ({ page }) => {
    await page.setViewportSize({ width, height });
    const watch = await LayoutMonitor.begin(page);
    const app = new App(page);
    let whole = 0;
    /** Expects that the step moved only controls that match `may`. */
    const expectStable = async (name: string, may: RegExp): Promise<void> => {
      const shifts = await watch.shifts();
      const jumped = shifts.filter(({ afterInput }) => !afterInput);
      whole += jumped.reduce((sum, { value }) => sum + value, 0);
      expect(whole, `${name}: ${JSON.stringify(jumped, null, 1)}`).toBeLessThan(MAX_LAYOUT_SHIFT);
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
    await app.until(
      ({ demo, reading, settings }) =>
        demo === 'ready' && !reading.song && !reading.leader && settings?.seed === 77,
    );
    await expectStable('the page with its demo', NOTHING);

    release();
    await app.settled();
    await expectStable('the model has come', OWN_BADGE);

    await page.getByRole('button', { name: 'Play the demo' }).click();
    await app.until(({ playback }) => playback.time > 0.3);
    await page.keyboard.press('Space');
    await expectStable('playing', NOTHING);

    await measured(() => page.getByRole('slider', { name: 'Coarse guidance' }).fill('0.7'));
    await expectStable('another reaction and its quality', OWN_LIST);

    await measured(() => page.getByRole('button', { name: 'New random seed' }).click());
    expect(await app.read(({ takes }) => takes.length)).toBe(3);
    await expectStable('another take and its quality', OWN_LIST);

    const matrix = page.getByRole('button', { name: /By body part/ });
    await matrix.click();
    await expect(page.getByRole('group', { name: 'Guidance by body part' })).toBeVisible();
    expect(await watch.movedElsewhere(matrix)).toEqual([]);
    await matrix.click();
    await expectStable('the matrix opened and closed', NOTHING);

    await page.getByRole('button', { name: /^Switch to / }).click();
    await expectStable('another theme', NOTHING);

    await page.getByRole('button', { name: 'Download', exact: true }).click();
    await expectStable('the download menu opens', NOTHING);
    await page.keyboard.press('Escape');
    await expectStable('the download menu closes', NOTHING);

    if (width < 761) return;
    const last = page.getByRole('button', { name: /^Use .* as B$/ }).last();
    // Where the list is low it is scrolled to it, which fades its ends a frame later.
    await last.scrollIntoViewIfNeeded();
    await watch.shifts();
    await watch.mark();
    await last.click();
    await expect(page.getByRole('radiogroup', { name: 'Compare takes' })).toBeVisible();
    await expectStable('a comparison', NOTHING);
  });
