import { readFile } from 'node:fs/promises';
import type { Page } from '@playwright/test';
import { App } from '../support/app-page';
import { expect, test } from '../support/fixtures';
import { openStudio, SHOT } from '../support/video-files';

// A small stage, for a software renderer.
test.use({ viewport: { width: 1000, height: 560 }, colorScheme: 'dark' });

/** Mean brightness of the left and the right half of a video's middle picture, 0 to 255. */
async function halvesOf(page: Page, file: string): Promise<[number, number]> {
  return page.evaluate(
    async (base64) => {
      const bytes = Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
      const video = document.createElement('video');
      video.src = URL.createObjectURL(new Blob([bytes]));
      await new Promise((resolve) => (video.onloadeddata = resolve));
      video.currentTime = video.duration / 2;
      await new Promise((resolve) => (video.onseeked = resolve));
      const context = new OffscreenCanvas(2, 1).getContext('2d')!;
      context.imageSmoothingQuality = 'high';
      context.drawImage(video, 0, 0, 2, 1);
      const { data } = context.getImageData(0, 0, 2, 1);
      const mean = (i: number): number => (data[i]! + data[i + 1]! + data[i + 2]!) / 3;
      return [mean(0), mean(4)];
    },
    (await readFile(file)).toString('base64'),
  );
}

test('a video becomes the leader, gets a partner, and is shown beside it in the exported video', async ({
  page,
  browser,
}) => {
  const studio = await openStudio(browser);
  const video = Buffer.from(await studio.call('film', 'salsa', SHOT, 3), 'base64');
  await studio.close();
  const app = new App(page);
  await app.open();
  await app.settled();
  await app.drop({ name: 'dance.webm', mimeType: 'video/webm', buffer: video });
  const panel = page.getByRole('region', { name: 'Video of the leader' });
  await expect(panel.getByRole('progressbar')).toBeVisible();
  await app.reaction('dance.webm');
  await expect(panel.getByText(/The dancer is the leader now/)).toBeVisible();
  const lane = page.getByRole('img', { name: /The video dance.webm; confidence over 2\.\d s of dance/ });
  await expect(lane).toBeVisible();
  const reactor = await app.reactor();
  expect(reactor.length / 66).toBeGreaterThan(75);
  expect(reactor.every(Number.isFinite)).toBe(true);

  await page.getByRole('button', { name: 'Download', exact: true }).click();
  await page.getByRole('radio', { name: /As on stage/ }).click();
  await page.getByRole('checkbox', { name: 'Show the leader’s video beside it' }).check();
  const coming = page.waitForEvent('download');
  await page.getByRole('button', { name: 'Save video' }).click();
  const [left, right] = await halvesOf(page, await (await coming).path());
  // The studio is bright, and the stage is dark.
  expect(left).toBeGreaterThan(right + 25);
  await page.keyboard.press('Escape');

  // What can't be read is a sentence, and the leader stays.
  await app.drop({
    name: 'broken.mp4',
    mimeType: 'video/mp4',
    buffer: Buffer.from('\0\0\0\x20ftypisom and no more'),
  });
  await expect(app.alert).toHaveAttribute('data-code', 'not-a-video');
  expect(await app.read(({ leader }) => leader?.name)).toBe('dance.webm');
});
