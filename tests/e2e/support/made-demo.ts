import type { Page } from '@playwright/test';
import { bvhText, wav } from './files';

/** Settings that a made reaction may say that it was made with. */
const withGuidance = (coarse: number, fine: number, music: number, seed: number): object => {
  const column = { coarse, fine };
  return {
    guidance: { upper: column, lower: column, placement: column },
    music,
    variety: 1,
    seed,
    role: 'reactor',
  };
};

export const demoSettings = withGuidance(0.5, 0.25, 1.5, 77);
/** What the page has at the start. */
export const usualSettings = withGuidance(0, 0, 8, 1206);

/** Content of a made demo by file name, with or without its ready-made reaction. */
export function demoFiles(settings: object | null, frames: number): Record<string, string | Buffer> {
  const named = (file: string, label: string): object => ({ file, name: `Made ${label}`, label });
  const reactor = { file: 'reactor.bvh', label: 'demo reaction', settings };
  const demo = {
    song: named('song.wav', 'demo song'),
    leader: named('leader.bvh', 'demo leader'),
    ...(settings ? { reactor } : {}),
  };
  return {
    'demo.json': JSON.stringify(demo),
    'song.wav': wav({ seconds: frames / 30 }).buffer,
    'leader.bvh': bvhText({ frames }),
    'reactor.bvh': bvhText({ frames, sway: 0.5 }),
  };
}

/** A made demo on this page alone, in the place of the one that the site has. */
export async function serveDemo(page: Page, settings: object | null, frames = 90): Promise<void> {
  const files = demoFiles(settings, frames);
  await page.route('**/demo/*', (route) => {
    const body = files[new URL(route.request().url()).pathname.split('/').at(-1) ?? ''];
    return body === undefined ? route.fulfill({ status: 404 }) : route.fulfill({ body });
  });
}
