import type { PictureSize } from '../../common/picture';

/** Sizes of a video: two common ones of 16:9, a square, an upright one for phones, and that of the picture on the stage. */
export const VIDEO_SIZES = ['720p', '1080p', '1x1', '9x16', 'stage'] as const;
export type VideoSize = (typeof VIDEO_SIZES)[number];

/** Rounded to an even number: encoders subsample colour by two (4:2:0). */
const even = (pixels: number): number => Math.max(2, 2 * Math.round(pixels / 2));

/**
 * Size of a video in pixels.
 *
 * @param stage size of the picture on the stage, pixels
 */
export function videoPixels(size: VideoSize, stage: PictureSize): PictureSize {
  switch (size) {
    case '720p':
      return { width: 1280, height: 720 };
    case '1080p':
      return { width: 1920, height: 1080 };
    case '1x1':
      return { width: 1080, height: 1080 };
    case '9x16':
      return { width: 1080, height: 1920 };
    case 'stage':
      return { width: even(stage.width), height: even(stage.height) };
  }
}
