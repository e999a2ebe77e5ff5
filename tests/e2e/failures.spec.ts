import { brokenLeaders, bvh, emptyFile, notAudio, wav, type TestFile } from './support/files';
import { App, SHIPPED } from './support/app-page';
import { expect, test } from './support/fixtures';
import { rested } from './support/stage-rest';

/** Expects the problem dialog with this title and hint, and closes it, by Escape if not otherwise said. */
async function expectProblem(
  app: App,
  title: RegExp,
  hint: RegExp,
  close = (): Promise<void> => app.page.keyboard.press('Escape'),
): Promise<void> {
  await expect(app.alert).toBeVisible({ timeout: 60_000 });
  await expect(app.alert.getByRole('heading')).toHaveText(title);
  await expect(app.alert.getByRole('paragraph')).toHaveText(hint);
  // The first button of the dialog has the focus.
  await expect(app.alert.getByRole('button').first()).toBeFocused();
  await close();
  await expect(app.alert).toBeHidden();
}

/** Expects that the page still works: a valid leader gets its partner. */
async function expectStillGenerates(app: App): Promise<void> {
  await app.chooseLeader(bvh({ frames: 60, name: 'valid.bvh' }));
  await app.reaction('valid.bvh');
}

const HINT = /[a-z].{20,}\.$/i;

test.describe('files', () => {
  const cases: readonly (readonly [string, () => TestFile, RegExp])[] = [
    ['not audio', notAudio, /^holiday\.mp3/],
    ['an empty file', emptyFile, /^nothing\.bvh is empty\.$/],
    [
      'neither song nor motion',
      () => ({ name: 'tax.pdf', mimeType: 'application/pdf', buffer: Buffer.from('%PDF-1.7') }),
      /^tax\.pdf is neither/,
    ],
    [
      'an FBX',
      () => ({ name: 'dance.fbx', mimeType: '', buffer: Buffer.from('Kaydara FBX Binary  \0') }),
      /^dance\.fbx: The FBX file is damaged/,
    ],
    ['a truncated BVH', brokenLeaders.truncated, /^cut off\.bvh/],
    ['a BVH without legs', brokenLeaders.noLegs, /^arms only\.bvh/],
    ['a BVH of one frame', brokenLeaders.oneFrame, /^statue\.bvh/],
    ['a BVH with NaN', brokenLeaders.notNumbers, /^not numbers\.bvh/],
  ];

  test('are refused one by one, and the page keeps what it had', async ({ page }) => {
    const app = new App(page);
    await app.openWithoutPicture();
    await app.drop(bvh({ frames: 60, name: 'good.bvh' }), wav({ seconds: 2, name: 'good.wav' }));
    await app.reaction('good.bvh');
    for (const [name, make, title] of cases) {
      await test.step(name, async () => {
        await app.drop(make());
        await expectProblem(app, title, HINT);
        expect(await app.read(({ leader, song }) => [leader?.name, song?.name])).toEqual([
          'good.bvh',
          'good.wav',
        ]);
        expect(await app.read(({ reaction }) => reaction?.inputs.leader.name)).toBe('good.bvh');
      });
    }
    await expectStillGenerates(app);
  });

  test('with a wrong extension are recognised by their content', async ({ page }) => {
    const app = new App(page);
    await app.openWithoutPicture();
    await app.chooseSong({ ...bvh({ frames: 60 }), name: 'song.mp3', mimeType: 'audio/mpeg' });
    await app.reaction('song.mp3');
    await app.chooseLeader({ ...wav({ seconds: 2 }), name: 'dance.bvh' });
    await app.until(({ song }) => song?.name === 'dance.bvh');
    await expect(app.alert).toBeHidden();
  });

  test('a song of twenty minutes is refused with its length', async ({ page }) => {
    const app = new App(page);
    await app.openWithoutPicture();
    await app.settled();
    await app.chooseSong(wav({ seconds: 1200, rate: 8000, name: 'symphony.wav' }));
    await expectProblem(app, /^symphony\.wav.*minutes/, HINT);
    await expectStillGenerates(app);
  });

  test('a silent song is danced to, and the page says so', async ({ page }) => {
    const app = new App(page);
    await app.openWithoutPicture();
    await app.drop(
      wav({ seconds: 2, silent: true, name: 'nothing heard.wav' }),
      bvh({ frames: 60, name: 'leader.bvh' }),
    );
    await app.reaction('leader.bvh');
    const note = page.getByRole('list', { name: 'Notes' }).getByText('The song is silent');
    await expect(note).toBeVisible();
    // A warning has a full dot, a remark a ring.
    expect(await note.evaluate((item) => getComputedStyle(item, '::before').boxShadow)).toBe('none');
  });
});

test.describe('the model', () => {
  test('missing on the server is reported, and can be tried again', async ({ page }) => {
    const app = new App(page);
    let missing = true;
    await page.route('**/models/tiny/*.onnx', (route) =>
      missing ? route.fulfill({ status: 404, body: 'no' }) : route.continue(),
    );
    await app.openWithoutPicture();
    await expectProblem(app, /404/, HINT);
    await app.chooseLeader(bvh({ frames: 60, name: 'patient.bvh' }));
    await app.until(({ leader, job }) => leader?.name === 'patient.bvh' && !job);
    missing = false;
    await page.getByRole('button', { name: 'Try again' }).click();
    await expect(page.locator('.badge').getByRole('button')).toBeFocused();
    await app.until(({ model }) => model.phase === 'ready');
    // What waited for the model is made without another click.
    await app.reaction('patient.bvh');
  });

  test('is loaded again when the connection is back, and what waited for it is made', async ({ page }) => {
    const app = new App(page);
    let lost = true;
    await page.route('**/models/tiny/step*', (route) => (lost ? route.abort() : route.continue()));
    await app.openWithoutPicture();
    await expect(app.alert.getByRole('heading')).toHaveText(/could not be fetched/);
    await app.drop(bvh({ frames: 60, name: 'patient.bvh' }));
    await app.until(({ leader, job }) => leader?.name === 'patient.bvh' && !job);
    lost = false;
    await page.evaluate(() => dispatchEvent(new Event('online')));
    await app.reaction('patient.bvh');
    await expect(app.alert).toBeHidden();
  });

  test('served as a web page is recognised', async ({ page }) => {
    const app = new App(page);
    await page.route('**/models/tiny/manifest.json', (route) =>
      route.fulfill({ contentType: 'text/html', body: '<!doctype html><title>Not here</title>' }),
    );
    await app.openWithoutPicture();
    await expectProblem(app, /web page instead of the model/, HINT);
  });

  test('works without storage', async ({ page, baseURL }) => {
    const session = await page.context().newCDPSession(page);
    await session.send('Storage.overrideQuotaForOrigin', {
      origin: new URL(baseURL ?? '').origin,
      quotaSize: 1000,
    });
    const app = new App(page);
    await app.openWithoutPicture();
    await expectStillGenerates(app);
    await expect(page.getByRole('list', { name: 'Notes' })).toContainText('could not keep the model');
  });

  test('runs without WebGPU, with the reason', async ({ page }) => {
    const app = new App(page);
    await page.addInitScript(() => {
      Object.defineProperty(navigator, 'gpu', { value: undefined });
    });
    await app.openWithoutPicture('/?model=/models/tiny/manifest.json');
    await app.until(({ model }) => model.phase === 'ready');
    expect(await app.read(({ model }) => model.phase === 'ready' && model.backend)).toBe('wasm');
    await expect(page.getByRole('banner')).toContainText('Processor');
    await expect(page.getByRole('complementary')).toContainText(/WebGPU/);
    await expectStillGenerates(app);
  });

  test('crashing is reported, and the next attempt starts a new worker', async ({ page }) => {
    const app = new App(page);
    // The real model and five minutes of dance: that takes seconds, so that the crash comes in the middle of them.
    await app.openWithoutPicture(SHIPPED);
    await app.settled();
    await app.chooseLeader(bvh({ frames: 9000, name: 'unlucky.bvh' }));
    await app.reaction('unlucky.bvh');
    const generate = page.getByRole('button', { name: 'Generate' });
    await generate.press('Enter');
    await app.until(({ job }) => job?.stage === 'step');
    const cancel = page.getByRole('button', { name: /^Cancel/ });
    await expect(cancel).toBeVisible();
    await cancel.focus();
    const worker = page.workers().find((one) => /worker/.test(one.url()) && !/leader-worker/.test(one.url()));
    await worker?.evaluate('setTimeout(() => { throw new Error("out of luck"); })');
    await expectProblem(app, /stopped unexpectedly/, HINT);
    await expect(generate).toBeFocused();
    const failed = await app.read(({ reaction }) => reaction?.inputs.settings.seed);
    await generate.click();
    await app.until(({ reaction, job }, seed) => !job && reaction?.inputs.settings.seed !== seed, failed);
  });

  test('falling silent is noticed, also after a cancelled request, and Try again starts afresh', async ({
    page,
  }) => {
    // Ends the model's worker from outside, of which the page gets no word, and lets the minutes pass faster.
    await page.addInitScript(() => {
      const opened: Worker[] = [];
      const Real = Worker;
      const repeat = window.setInterval.bind(window);
      window.Worker = class extends Real {
        constructor(...options: ConstructorParameters<typeof Worker>) {
          super(...options);
          if (options[1]?.name === 'model') opened.push(this);
        }
      };
      Object.assign(window, {
        killModel: () => {
          opened.at(-1)?.terminate();
          Object.assign(window, { setInterval: (run: () => void, ms: number) => repeat(run, ms / 10) });
        },
        slowDown: () => Object.assign(window, { setInterval: repeat }),
      });
    });
    const app = new App(page);
    await app.openWithoutPicture();
    await app.settled();
    await page.evaluate('killModel()');
    await app.chooseLeader(bvh({ frames: 60, name: 'patient.bvh' }));
    await page.getByRole('button', { name: /^Cancel/ }).click();
    await app.until(({ job }) => !job);
    await page.getByRole('button', { name: 'Generate' }).click();
    await expectProblem(app, /no answer for 60 seconds/, HINT, async () => {
      await page.evaluate('void slowDown()');
      await app.alert.getByRole('button', { name: 'Try again' }).click();
    });
    await app.reaction('patient.bvh');
  });
});

test('without WebGL the page still generates and downloads the motion', async ({ page }) => {
  const app = new App(page);
  await app.openWithoutPicture();
  await expectStillGenerates(app);
  await expect(page.getByRole('button', { name: 'Download', exact: true })).toBeEnabled();
});

test('a lost graphics card leaves a sentence on the stage, and the picture comes back with the card', async ({
  page,
}) => {
  const app = new App(page);
  await app.open();
  await app.drop(bvh({ frames: 60, name: 'valid.bvh' }));
  await app.reaction('valid.bvh');
  await rested(page);
  const before = await app.warmPixels();
  // The stage may show a copy of the canvas that it draws on.
  const card = await page.evaluateHandle<WEBGL_lose_context>(
    `window.reactdance.stage.view.canvas.renderer.getContext().getExtension('WEBGL_lose_context')`,
  );
  await card.evaluate((extension) => {
    extension.loseContext();
  });
  const note = page.getByRole('status').filter({ hasText: /graphics card has stopped/ });
  await expect(note).toBeVisible();
  await card.evaluate((extension) => {
    extension.restoreContext();
  });
  await expect(note).toBeHidden();
  await expect
    .poll(async () => (await app.warmPixels()).size, { timeout: 30_000 })
    .toBeGreaterThan(0.8 * before.size);
});

test('a page whose first script does not come says so after a while, and no other one does', async ({
  page,
}) => {
  const help = page.getByText(/check the connection and reload\s+the page/);
  await page.route('**/assets/index-*.js', (route) => route.abort());
  await page.goto('/');
  await expect(help).toBeHidden();
  await expect(help).toBeVisible();
  await page.unrouteAll();
  await new App(page).openWithoutPicture();
  await expect(help).not.toBeAttached();
});
