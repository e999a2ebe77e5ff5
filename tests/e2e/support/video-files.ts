/** Videos for tests, made by the page in video-page/. */
import path from 'node:path';
import type { Browser } from '@playwright/test';
import { servePage } from '../../../tools/bench/built-page.mjs';
import type { Shot } from '../../web/support/filmed/shots';
import type { Page } from './video-page/main';

/** A dancer of ours, clothed as the networks expect people to be, filmed at the height of a chest. */
export const SHOT: Shot = {
  width: 360,
  height: 480,
  focal: 430,
  position: [0.4, 1.3, 3.4],
  target: [0, 0.9, 0],
  fps: 12,
  clothed: true,
};

/** The page that films and reads, in a browser; `close` ends it. */
export interface VideoStudio {
  call<K extends keyof Page>(name: K, ...args: Parameters<Page[K]>): Promise<Awaited<ReturnType<Page[K]>>>;
  close(): Promise<void>;
}

export async function openStudio(browser: Browser): Promise<VideoStudio> {
  const project = path.resolve(import.meta.dirname, '../../..');
  const site = await servePage(path.join(import.meta.dirname, 'video-page'), {
    '/models/': path.join(project, 'web/public/models'),
  });
  const page = await browser.newPage();
  await page.goto(site.url);
  return {
    call: (name, ...args) => page.evaluate(`video.${name}(...${JSON.stringify(args)})`),
    close: async () => {
      await page.close();
      await site.close();
    },
  };
}

/** An MP4 file with all boxes of a name changed, their content given without its header of eight bytes. */
export function patched(file: Buffer, box: string, change: (content: Buffer) => void): Buffer {
  const out = Buffer.from(file);
  for (let at = out.indexOf(box); at >= 0; at = out.indexOf(box, at + 4))
    change(out.subarray(at + 4, at - 4 + out.readUInt32BE(at - 4)));
  return out;
}
