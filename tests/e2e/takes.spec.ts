import { readFileSync } from 'node:fs';
import type { Locator, Page } from '@playwright/test';
import { bvh, wav } from './support/files';
import { App, maxDistance } from './support/app-page';
import { expect, test } from './support/fixtures';

/** The list of takes as a visitor sees it. */
const takes = (page: Page): Locator => page.getByRole('grid', { name: 'Takes' }).getByRole('row');
const take = (page: Page, name: string): Locator => takes(page).filter({ hasText: name });
/** Joint positions of the coarse ghost, decoded from the latents of the take on the stage. */
async function coarseGhost(app: App): Promise<number[]> {
  await app.page.keyboard.press('g');
  await app.until(({ coarse, overlays }) => overlays.ghost && coarse.motion && !coarse.decoding);
  const positions = await app.read(({ coarse }) => Array.from(coarse.motion?.positions ?? []));
  await app.page.keyboard.press('g');
  return positions;
}
const titles = (page: Page): Promise<string[]> => takes(page).locator('b').allTextContents();

/** A page with two takes of its own: `Take 1` and, on the stage, `Take 2`. */
async function withTwoTakes(page: Page, frames = 90, before?: (app: App) => Promise<void>): Promise<App> {
  await page.route('**/demo/*', (route) => route.fulfill({ status: 404 }));
  const app = new App(page);
  await app.openWithoutPicture();
  await before?.(app);
  await app.drop(wav({ seconds: 6, name: 'my song.wav' }), bvh({ frames, name: 'mine.bvh' }));
  await app.until(({ reaction, song, job }) => reaction?.inputs.song === song && song && !job);
  await page.getByRole('spinbutton', { name: 'Seed' }).fill('77');
  await page.keyboard.press('Enter');
  await app.until(({ reaction, job }) => reaction?.inputs.settings.seed === 77 && !job);
  await page.evaluate('document.activeElement.blur()');
  await expect(takes(page)).toHaveCount(2);
  return app;
}

/** The names of the takes in the browser's database; null for those without a name. */
async function storedTakeNames(page: Page): Promise<(string | null)[]> {
  return page.evaluate(`new Promise((resolve, reject) => {
    const open = indexedDB.open('reactdance');
    open.onerror = () => reject(open.error);
    open.onsuccess = () => {
      const all = open.result.transaction('takes').objectStore('takes').getAll();
      all.onsuccess = () => { open.result.close(); resolve(all.result.map((take) => take.name)); };
    };
  })`);
}

/** Waits until a take of this name is stored; when storage is full the page tries again every 20 s. */
async function takeStored(page: Page, name: string): Promise<void> {
  await expect.poll(() => storedTakeNames(page), { timeout: 50_000 }).toContain(name);
}

test('takes are named, starred, compared at the same playhead, deleted and restored', async ({ page }) => {
  const app = await withTwoTakes(page);
  const [newer = '', older = ''] = await titles(page);
  const second = await app.reactor();
  await expect(take(page, newer)).toHaveAttribute('aria-selected', 'true');

  await test.step('a click shows a take without generating it again', async () => {
    await page.keyboard.press('End');
    await take(page, older).click();
    await expect(take(page, older)).toHaveAttribute('aria-selected', 'true');
    expect(maxDistance(second, await app.reactor())).toBeGreaterThan(1e-4);
    expect(await app.read(({ job, playback }) => [job, playback.time])).toEqual([null, 3]);
    await expect(page.getByRole('spinbutton', { name: 'Seed' })).not.toHaveValue('77');
  });

  await test.step('the keys of the list', async () => {
    await take(page, older).focus();
    await page.keyboard.press('ArrowUp');
    await expect(take(page, newer)).toBeFocused();
    await page.keyboard.press('Enter');
    expect(maxDistance(second, await app.reactor())).toBe(0);
    await page.keyboard.press('s');
    await expect(page.getByRole('button', { name: `Star ${newer}` })).toHaveAttribute('aria-pressed', 'true');
    await page.keyboard.press('F2');
    await page.getByRole('textbox', { name: 'Name of the take' }).fill('Softer hands');
    await page.keyboard.press('Enter');
    await expect(take(page, 'Softer hands')).toBeFocused();
    await page.keyboard.press('F2');
    await page.keyboard.type('Nothing of this');
    await page.keyboard.press('Escape');
    await expect(takes(page)).toContainText(['Softer hands', older]);
  });

  await test.step('a double click in the name that is being typed selects a word of it', async () => {
    await page.keyboard.press('F2');
    const field = page.getByRole('textbox', { name: 'Name of the take' });
    await field.fill('Wide turns');
    await field.dblclick({ position: { x: 12, y: 10 } });
    await page.keyboard.type('Slow');
    await expect(field).toHaveValue(/^Slow ?turns$/);
    // Enter that ends the composition of a letter is none of the page's.
    await field.dispatchEvent('keydown', { key: 'Enter', isComposing: true });
    await expect(field).toBeVisible();
    await page.keyboard.press('Escape');
    await expect(take(page, 'Softer hands')).toBeFocused();
  });

  await test.step('the take with letter A can get B, and the other one gets A', async () => {
    await page.getByRole('button', { name: 'Use Softer hands as B' }).click();
    await expect(page.getByRole('button', { name: `Use ${older} as A` })).toHaveAttribute(
      'aria-pressed',
      'true',
    );
    await page.getByRole('button', { name: 'Use Softer hands as A' }).click();
    await page.getByRole('button', { name: `Use ${older} as B` }).click();
    await expect(page.getByRole('radiogroup', { name: 'Compare takes' })).toBeHidden();
  });

  await test.step('A and B flip on the same playhead', async () => {
    await page.getByRole('button', { name: `Use ${older} as B` }).click();
    const compare = page.getByRole('radiogroup', { name: 'Compare takes' });
    await expect(compare.getByRole('radio', { name: 'A' })).toBeChecked();
    await page.keyboard.press('b');
    await expect(compare.getByRole('radio', { name: 'B' })).toBeChecked();
    await expect(take(page, older)).toHaveAttribute('aria-selected', 'true');
    expect(await app.read(({ playback }) => playback.time)).toBe(3);
    // Held for longer than 350 ms, it is a look: the time that the key is down is what is tested.
    await page.keyboard.down('b');
    await expect(compare.getByRole('radio', { name: 'A' })).toBeChecked();
    await page.waitForTimeout(500);
    await page.keyboard.up('b');
    await expect(compare.getByRole('radio', { name: 'B' })).toBeChecked();
    await compare.getByRole('radio', { name: 'A' }).click();
    await expect(take(page, 'Softer hands')).toHaveAttribute('aria-selected', 'true');
    // Tab flips only after a click on the stage, and with Shift leaves it.
    await page.keyboard.press('Tab');
    await expect(compare.getByRole('radio', { name: 'A' })).toBeChecked();
    const picture = page.locator('.picture');
    await picture.focus();
    await page.keyboard.press('Tab');
    await expect(compare.getByRole('radio', { name: 'B' })).toBeChecked();
    await page.keyboard.press('Tab');
    await expect(compare.getByRole('radio', { name: 'A' })).toBeChecked();
    await expect(picture).toBeFocused();
    await page.keyboard.press('Shift+Tab');
    await expect(picture).not.toBeFocused();
    await page.evaluate('document.activeElement.blur()');
  });

  await test.step('delete, undo and redo', async () => {
    await take(page, older).focus();
    for (let times = 0; times < 3; times++) await page.keyboard.down('Delete');
    await page.keyboard.up('Delete');
    await expect(takes(page), 'held, the key deletes one').toHaveCount(1);
    await page.keyboard.press('Control+z');
    await expect(takes(page)).toHaveCount(2);
    await take(page, older).hover();
    await page.getByRole('button', { name: `Delete ${older}` }).click();
    await expect(takes(page)).toHaveCount(1);
    await page.keyboard.press('Control+z');
    await expect(takes(page)).toHaveCount(2);
    await page.getByRole('button', { name: 'Redo', exact: true }).click();
    await expect(takes(page)).toHaveCount(1);
    await page.getByRole('button', { name: 'Undo', exact: true }).click();
    await expect(takes(page)).toHaveCount(2);
    // The second click of a double click is where the next take has moved to.
    await takes(page).first().hover();
    await takes(page)
      .first()
      .getByRole('button', { name: /^Delete/ })
      .dblclick();
    await expect(takes(page)).toHaveCount(1);
    await page.keyboard.press('Control+z');
    await expect(takes(page)).toHaveCount(2);
  });

  await test.step('a take’s line shows its differences, and the tooltip of a disabled letter the reason', async () => {
    await page.getByRole('button', { name: 'Swap roles' }).click();
    await app.until(({ reaction, job }) => reaction?.inputs.settings.role === 'leader' && !job);
    await expect(takes(page).first()).toContainText('as leader, ');
    await expect(page.getByRole('radiogroup', { name: 'Compare takes' })).toBeHidden();
    const letter = page.getByRole('button', { name: `Use ${older} as B` });
    await expect(letter).toBeDisabled();
    await expect(letter).toHaveAccessibleDescription('This take dances the other role.');
    for (const [seed, count] of [
      ['78', 4],
      ['79', 5],
      ['80', 6],
    ] as const) {
      await page.getByRole('spinbutton', { name: 'Seed' }).fill(seed);
      await page.keyboard.press('Enter');
      await app.until(({ takes, job }, wanted) => takes.length === wanted && !job, count);
    }
    const list = page.getByRole('grid', { name: 'Takes' });
    await expect(list).toHaveClass('takes below');
    await takes(page).last().focus();
    await expect(list).toHaveClass('takes above');
  });

  await test.step('a long list leaves the switches above it free', async () => {
    for (const [width, height] of [
      [1440, 900],
      [1366, 768],
      [1280, 720],
    ] as const) {
      await page.setViewportSize({ width, height });
      const lock = (await page.getByRole('switch', { name: 'Foot lock' }).boundingBox())!;
      const section = (await page.locator('.takes-sec').boundingBox())!;
      expect(lock.y + lock.height, String(height)).toBeLessThanOrEqual(section.y);
    }
  });

  await test.step('and the reactions with their buttons in low windows', async () => {
    for (const height of [600, 540]) {
      await page.setViewportSize({ width: 1280, height });
      const again = (await page.getByRole('button', { name: 'Generate again' }).boundingBox())!;
      const section = (await page.locator('.takes-sec').boundingBox())!;
      expect(again.y + again.height, String(height)).toBeLessThanOrEqual(section.y);
    }
  });
});

test('everything is restored after a reload, and from a project file after the page was emptied', async ({
  page,
}) => {
  const app = await withTwoTakes(page);
  const [newer = '', older = ''] = await titles(page);
  const summary = () =>
    app.read(({ takes, reaction, song, leader, settings, other, countings, playback }) => ({
      takes: takes.map(({ id, name, starred, reaction: { inputs } }) => [id, name, starred, inputs.settings]),
      files: [song?.name, song?.data.rhythm.beats, leader?.name, leader?.files[0]?.bytes.length],
      settings,
      other,
      countings,
      time: playback.time,
      answers: reaction?.inputs.leader === leader && reaction?.inputs.song === song,
    }));
  await page.getByRole('button', { name: `Star ${older}` }).click();
  await page.getByRole('button', { name: `Use ${older} as B` }).click();
  await page.locator('.lane.ruler').click({ modifiers: ['Alt'], position: { x: 200, y: 12 } });
  await page.keyboard.press('End');
  await take(page, newer).dblclick();
  await page.keyboard.type('Softer hands');
  await page.keyboard.press('Enter');
  const before = await summary();
  const motion = await app.reactor();
  const ghost = await coarseGhost(app);
  expect(maxDistance(ghost, motion)).toBeGreaterThan(1e-4);
  expect(before.takes).toHaveLength(2);
  expect(before.countings).toHaveLength(1);
  expect(before.answers).toBe(true);

  await test.step('a reload', async () => {
    await takeStored(page, 'Softer hands');
    await page.reload();
    await app.until(
      ({ takes, song, reaction }) => takes.length === 2 && song && reaction?.inputs.song === song,
    );
    await expect(page.getByRole('heading', { name: /Drop a video/ })).toBeHidden();
    expect(await summary()).toEqual(before);
    expect(maxDistance(motion, await app.reactor())).toBe(0);
    await page.keyboard.press('Escape');
    await page.keyboard.press('Escape');
    await app.until(({ model, job }) => model.phase === 'ready' && !job);
    // All of it was there, also what the coarse ghost is decoded from: nothing had to be made.
    expect(maxDistance(motion, await app.reactor())).toBe(0);
    expect(maxDistance(ghost, await coarseGhost(app))).toBe(0);
    expect(await summary()).toEqual(before);
  });

  const saved = await test.step('a project is saved', async () => {
    const coming = page.waitForEvent('download');
    await page.keyboard.press('Control+s');
    const download = await coming;
    expect(download.suggestedFilename()).toBe('my-song_mine.reactdance');
    return readFileSync(await download.path());
  });

  await test.step('the page is emptied, also after a reload', async () => {
    await page.getByRole('button', { name: 'Project' }).click();
    await page
      .getByRole('dialog', { name: 'Project' })
      .getByRole('button', { name: /Start over/ })
      .click();
    await expect(page.getByRole('heading', { name: /Drop a video/ })).toBeVisible();
    await expect(takes(page)).toHaveCount(0);
    await expect.poll(() => storedTakeNames(page)).toEqual([]);
    await page.reload();
    await app.until(({ demo }) => demo === 'missing');
    await expect(takes(page)).toHaveCount(0);
    await page.keyboard.press('Escape');
  });

  await test.step('the project is opened, and an error of a broken one is explained', async () => {
    await app.drop({ name: 'dance.reactdance', mimeType: '', buffer: saved });
    await app.until(
      ({ takes, song, reaction }) => takes.length === 2 && song && reaction?.inputs.song === song,
    );
    await expect(page.getByText('Opened: my song.wav, mine.bvh, 2 takes').first()).toBeVisible();
    expect(await summary()).toEqual(before);
    expect(maxDistance(motion, await app.reactor())).toBe(0);
    expect(maxDistance(ghost, await coarseGhost(app))).toBe(0);
    await app.drop({ name: 'torn.reactdance', mimeType: '', buffer: saved.subarray(0, saved.length / 2) });
    await expect(app.alert).toContainText('torn.reactdance: The project is cut off or damaged.');
    await page.keyboard.press('Escape');
    expect(await summary()).toEqual(before);
  });

  await test.step('opening another project can be undone', async () => {
    await take(page, older).focus();
    await page.keyboard.press('Delete');
    await app.drop({ name: 'dance.reactdance', mimeType: '', buffer: saved });
    await app.until(({ takes }) => takes.length === 2);
    await page.keyboard.press('Control+z');
    await expect(takes(page)).toHaveCount(1);
    await expect(takes(page)).toContainText(['Softer hands']);
  });
});

test('starting over that was undone before the demo was there loads it when it is redone', async ({
  page,
}) => {
  const app = new App(page);
  await app.openWithoutPicture();
  await app.settled();
  await page.keyboard.press('s');
  await page.getByRole('button', { name: 'Project', exact: true }).click();
  await page.getByRole('button', { name: /Start over/ }).click();
  await page.keyboard.press('Control+z');
  await app.until(({ takes }) => takes[0]?.starred);
  await page.waitForTimeout(1000);
  await page.keyboard.press('Control+y');
  await app.until(({ takes }) => takes[0] && !takes[0].starred);
  await expect(page.getByRole('button', { name: 'Play the demo' })).toBeEnabled();
});

test('full storage is reported, nothing on the page is lost, and autosave goes on when there is room', async ({
  page,
}) => {
  const session = await page.context().newCDPSession(page);
  const leave = async (room: number): Promise<void> => {
    const used = await page.evaluate(async () => (await navigator.storage.estimate()).usage ?? 0);
    const origin = new URL(page.url()).origin;
    await session.send('Storage.overrideQuotaForOrigin', { origin, quotaSize: used + room });
  };
  // As if the disk were nearly full: there is room for a few takes of 30 s.
  const app = await withTwoTakes(page, 900, async (opened) => {
    await opened.until(({ model }) => model.phase === 'ready');
    await leave(2_500_000);
  });
  const rename = async (row: Locator, name: string): Promise<void> => {
    await row.dblclick();
    await page.keyboard.type(name);
    await page.keyboard.press('Enter');
  };
  const oldest = (await titles(page)).at(-1) ?? '';
  const isFull = () => app.read(({ autosave }) => autosave === 'full');
  let count = 2;
  for (; !(await isFull()) && count < 12; count++) {
    await expect.poll(async () => (await storedTakeNames(page)).length).toBe(count);
    await page.getByRole('spinbutton', { name: 'Seed' }).fill(String(100 + count));
    await page.keyboard.press('Enter');
    await app.until(({ takes }, before) => takes.length > before, count);
    await expect
      .poll(async () => (await isFull()) || (await storedTakeNames(page)).length > count)
      .toBe(true);
  }
  await expect(app.alert).toContainText('The space that this browser has for the page is full.');
  await expect(app.alert).toContainText('Delete takes that you don’t need');
  await expect(app.alert.getByRole('button', { name: 'Save project' })).toBeVisible();
  await app.alert.getByRole('button', { name: 'Close' }).click();
  const note = page.getByRole('list', { name: 'Notes' }).getByText(/^The space .* is full/);
  await expect(note).toBeVisible();
  await expect(takes(page)).toHaveCount(count);
  expect(await storedTakeNames(page)).toHaveLength(count - 1);
  const newest = await app.reactor();

  // What is small is kept all the same, and it is said only once. How much the takes left over is chance.
  await leave(150_000);
  await rename(takes(page).nth(1), 'Softer hands');
  await takeStored(page, 'Softer hands');
  await expect(app.alert).toBeHidden();

  await take(page, oldest).focus();
  await page.keyboard.press('Delete');
  // Chromium gives the space of what is deleted back when it tidies up, which may be minutes later.
  await leave(2_500_000);
  // The page tries again every 20 s.
  await expect(note).toBeHidden({ timeout: 50_000 });
  await rename(takes(page).first(), 'There at last');
  await takeStored(page, 'There at last');
  await page.reload();
  await app.until(({ takes }, rest) => takes.length === rest, count - 1);
  await take(page, 'There at last').click();
  expect(maxDistance(newest, await app.reactor())).toBe(0);
});

test('a browser without storage is reported, and the page works', async ({ page }) => {
  await page.addInitScript(() => {
    Reflect.set(IDBFactory.prototype, 'open', () => {
      throw new DOMException('Not in this window.', 'SecurityError');
    });
  });
  await withTwoTakes(page);
  await expect(page.getByRole('list', { name: 'Notes' })).toContainText('saves nothing');
});
