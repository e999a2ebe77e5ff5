/** Bits of a video's sound a second. */
export const AUDIO_BITRATE = 160_000;

/** Frames and sound of a video. */
export interface VideoSource {
  readonly fps: number;
  readonly frames: number;
  readonly canvas: HTMLCanvasElement;
  /**
   * Draws a frame on the canvas, where it stays until the task ends in which the promise is settled. Frame numbers
   * ascend; some may be left out.
   */
  readonly draw: (frame: number) => void | Promise<void>;
  readonly sound: Soundtrack | null;
}

interface Soundtrack {
  /** A sound file that the browser can decode. */
  readonly file: Blob;
  /** Moment of the dance at which the song begins, seconds; negative when its beginning is cut off. */
  readonly start: number;
}

export interface VideoOptions {
  readonly signal: AbortSignal;
  /** Called with the number of frames that are written. */
  readonly onProgress: (frames: number) => void;
}
