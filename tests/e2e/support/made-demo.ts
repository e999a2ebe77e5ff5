import type { Page } from '@playwright/test';
import { bvhText, wav } from './files';

/** What a made reaction may say that it was made with. */
export const demoSettings = {
  guidance: {
    upper: { coarse: 0.5, fine: 0.25 },
    lower: { coarse: 0.5, fine: 0.25 },
    placement: { coarse: 0.5, fine: 0.25 },
  },
  music: 1.5,
  variety: 1,
  seed: 77,
  role: 'reactor',
};

/** A made demo in the place of the shipped one, with or without its ready-made reaction. */
export async function serveDemo(page: Page, settings: object | null, frames = 90): Promise<void> {
  const named = (file: string, label: string): object => ({ file, name: `Made ${label}`, label });
  const reactor = { file: 'reactor.bvh', label: 'demo reaction', settings };
  const demo = {
    song: named('song.wav', 'demo song'),
    leader: named('leader.bvh', 'demo leader'),
    ...(settings ? { reactor } : {}),
  };
  const files: Record<string, string | Buffer> = {
    'demo.json': JSON.stringify(demo),
    'song.wav': wav({ seconds: 3 }).buffer,
    'leader.bvh': bvhText({ frames }),
    'reactor.bvh': bvhText({ frames, sway: 0.5 }),
  };
  await page.route('**/demo/*', (route) => {
    const body = files[new URL(route.request().url()).pathname.split('/').at(-1) ?? ''];
    return body === undefined ? route.fulfill({ status: 404 }) : route.fulfill({ body });
  });
}
