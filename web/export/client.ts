import type { PictureSize, Theme } from '../common/picture';
import type { Role } from '../common/role';
import { loadPart } from '../common/page-part';
import { createBodyLibrary } from '../view/body/library';
import { bvhExtension, writeBvhFile } from './bvh';
import type { Dance, MotionFormat } from './dance';
import { writeJson } from './json';
import { writeNpz } from './npz';
import type { VideoSource, VideoOptions } from './video/source';
import type { VideoPlan } from './video/plan';

export { partOf, type About, type Dance, type MotionFormat } from './dance';
export { atFrameRate, FRAME_RATES, type FrameRate } from './rate';
export { estimateBytes } from './sizes';
export { captioned } from './video/caption';
export { VIDEO_SIZES, videoPixels, type VideoSize } from './video/size';
export type { VideoPlan } from './video/plan';

const TYPES: Readonly<Record<MotionFormat, string>> = {
  bvh: 'text/plain',
  glb: 'model/gltf-binary',
  npz: 'application/octet-stream',
  json: 'application/json',
};

/** End of the name of a file in this format, with the number of dancers in it. */
export function motionExtension(format: MotionFormat, dancers: number): string {
  return format === 'bvh' ? bvhExtension(dancers) : `.${format}`;
}

/**
 * A dance as a file.
 *
 * @param theme whose colours the mannequins of a GLB have
 * @param nameOf file name of one dancer in an archive of two
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
      // Few visitors need the exporter: it is loaded on demand.
      const { writeGlb } = await loadPart(() => import('./glb'));
      const bodies = createBodyLibrary();
      try {
        return await writeGlb(dance, theme, bodies);
      } finally {
        bodies.dispose();
      }
    }
  }
}

/** How this browser can write a video of this size in pixels, with or without sound; null when it cannot. */
export async function planVideo(size: PictureSize, withSound: boolean): Promise<VideoPlan | null> {
  const { plan } = await loadPart(() => import('./video/plan'));
  return plan(size, withSound);
}

/**
 * Writes the video of a source with its song.
 *
 * @throws {AppError} `video-failed`, `sound-failed`; the signal's reason when it is aborted
 */
export async function writeVideo(source: VideoSource, plan: VideoPlan, options: VideoOptions): Promise<Blob> {
  const video = await loadPart(() => import('./video/write'));
  return video.writeVideo(source, plan, options);
}

/** Time from which on the pace of the work is known well enough to extrapolate, seconds. */
const MIN_ELAPSED = 0.8;

/** Remaining time in whole seconds at the pace so far; null while too little has been done to know it. */
export function secondsLeft(elapsed: number, done: number, total: number): number | null {
  if (elapsed < MIN_ELAPSED || done < 1) return null;
  return Math.ceil((elapsed / done) * (total - done));
}
