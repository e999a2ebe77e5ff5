import { createBodyLibrary } from '../view/body/library';
import type { Role, Theme } from '../view/theme';
import { bvhEnding, writeBvhFile } from './bvh';
import type { Dance, MotionFormat } from './dance';
import { writeJson } from './json';
import { writeNpz } from './npz';
import type { Footage, VideoOptions } from './video/footage';
import type { VideoPlan } from './video/plan';

export type { About, Dance, MotionFormat } from './dance';
export { estimateBytes } from './sizes';
export { VIDEO_SIZES, videoPixels, type VideoSize } from './video/size';
export type { VideoPlan } from './video/plan';

const TYPES: Readonly<Record<MotionFormat, string>> = {
  bvh: 'text/plain',
  glb: 'model/gltf-binary',
  npz: 'application/octet-stream',
  json: 'application/json',
};

/** How the name of a file in this format ends. */
export function motionEnding(format: MotionFormat, dancers: number): string {
  return format === 'bvh' ? bvhEnding(dancers) : `.${format}`;
}

/**
 * A dance as a file.
 *
 * @param theme whose colours the mannequins of a GLB wear
 * @param nameOf what the file of one dancer is called in an archive of two
 */
export async function writeMotion(
  format: MotionFormat,
  dance: Dance,
  theme: Theme,
  nameOf: (role: Role) => string = (role) => `${role}.bvh`,
): Promise<Blob> {
  return new Blob([await content(format, dance, theme, nameOf)], { type: TYPES[format] });
}

async function content(
  format: MotionFormat,
  dance: Dance,
  theme: Theme,
  nameOf: (role: Role) => string,
): Promise<BlobPart> {
  switch (format) {
    case 'bvh':
      return writeBvhFile(dance, new Date(), nameOf);
    case 'npz':
      return writeNpz(dance);
    case 'json':
      return writeJson(dance);
    case 'glb': {
      // Few visitors need the exporter: it comes when it is asked for.
      const { writeGlb } = await import('./glb');
      const bodies = createBodyLibrary();
      try {
        return await writeGlb(dance, theme, bodies);
      } finally {
        bodies.dispose();
      }
    }
  }
}

/** What videos this browser can write; with or without sound makes a difference. Null when it can write none. */
export async function planVideo(
  size: { readonly width: number; readonly height: number },
  withSound: boolean,
): Promise<VideoPlan | null> {
  const { plan } = await import('./video/plan');
  return plan(size, withSound);
}

/**
 * Films the footage with its song.
 *
 * @throws {AppError} `video-failed`, `sound-failed`; the signal's reason when it is aborted
 */
export async function writeVideo(footage: Footage, plan: VideoPlan, options: VideoOptions): Promise<Blob> {
  const video = await import('./video/write');
  return video.writeVideo(footage, plan, options);
}

/** Work this short says nothing about the rest yet, seconds. */
const SOON = 0.8;

/** Whole seconds that the rest will take if it goes on as so far; null while that is a guess. */
export function secondsLeft(elapsed: number, done: number, total: number): number | null {
  if (elapsed < SOON || done < 1) return null;
  return Math.ceil((elapsed / done) * (total - done));
}
