import { readFile } from 'node:fs/promises';
import type { JSHandle, Page } from '@playwright/test';

/** A video file that is open in a page, at the middle of its time. */
export interface WrittenVideo {
  readonly video: HTMLVideoElement;
  readonly bytes: Uint8Array<ArrayBuffer>;
}

/** Opens a video that the app has written, to look at its pictures and hear its sound. */
export async function openWritten(page: Page, file: string): Promise<JSHandle<WrittenVideo>> {
  return page.evaluateHandle(
    async (base64) => {
      const bytes = Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
      const video = document.createElement('video');
      video.src = URL.createObjectURL(new Blob([bytes]));
      await new Promise((resolve) => (video.onloadeddata = resolve));
      video.currentTime = video.duration / 2;
      await new Promise((resolve) => (video.onseeked = resolve));
      // A busy browser has no picture yet: then nothing is drawn.
      const pixel = new OffscreenCanvas(1, 1).getContext('2d', { willReadFrequently: true })!;
      for (;;) {
        pixel.drawImage(video, 0, 0, 1, 1);
        if (pixel.getImageData(0, 0, 1, 1).data[3] !== 0) break;
        await new Promise((resolve) => setTimeout(resolve, 50));
      }
      return { video, bytes };
    },
    (await readFile(file)).toString('base64'),
  );
}
