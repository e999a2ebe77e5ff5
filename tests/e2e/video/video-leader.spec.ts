import { fileURLToPath } from 'node:url';
import type { Browser } from '@playwright/test';
import { servePage } from '../../../tools/bench/built-page.mjs';
import { App } from '../support/app-page';
import { expect, test } from '../support/fixtures';
import type { Shot } from '../support/video-page/film';

/** A dancer of ours, clothed as the networks expect people to be, filmed at the height of a chest. */
const SHOT: Shot = {
  width: 360,
  height: 480,
  focal: 430,
  position: [0.4, 1.3, 3.4],
  target: [0, 0.9, 0],
  fps: 12,
  clothed: true,
};

/** A video that the page of the tests films. */
async function filmed(browser: Browser): Promise<Buffer> {
  const folder = fileURLToPath(new URL('../support/video-page', import.meta.url));
  const site = await servePage(folder, {});
  const page = await browser.newPage();
  try {
    await page.goto(site.url);
    const film = `video.film('salsa', ${JSON.stringify(SHOT)}, 3)`;
    return Buffer.from(await page.evaluate<string>(film), 'base64');
  } finally {
    await page.close();
    await site.close();
  }
}

test('a video becomes the leader, and the leader gets a partner', async ({ page, browser }) => {
  const video = await filmed(browser);
  const app = new App(page);
  await app.openWithoutPicture();
  await app.settled();
  await app.drop({ name: 'dance.webm', mimeType: 'video/webm', buffer: video });
  const panel = page.getByRole('region', { name: 'Video of the leader' });
  await expect(panel.getByRole('progressbar')).toBeVisible();
  await app.reaction('dance.webm');
  await expect(panel.getByText(/The dancer is the leader now/)).toBeVisible();
  await expect(panel.getByRole('img', { name: /Confidence over 2\.\d s of dance/ })).toBeVisible();
  const reactor = await app.reactor();
  expect(reactor.length / 66).toBeGreaterThan(75);
  expect(reactor.every(Number.isFinite)).toBe(true);

  // What can't be read is a sentence, and the leader stays.
  await app.drop({
    name: 'broken.mp4',
    mimeType: 'video/mp4',
    buffer: Buffer.from('\0\0\0\x20ftypisom and no more'),
  });
  await expect(app.alert).toHaveAttribute('data-code', 'not-a-video');
  expect(await app.read(({ leader }) => leader?.name)).toBe('dance.webm');
});
