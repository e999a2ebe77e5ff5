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
      return { video, bytes };
    },
    (await readFile(file)).toString('base64'),
  );
}
