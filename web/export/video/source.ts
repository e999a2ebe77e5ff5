/** Frames and sound of a video. */
export interface VideoSource {
  readonly width: number;
  readonly height: number;
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

export interface VideoProgress {
  /** Number of frames written. */
  readonly frame: number;
  readonly frames: number;
}

export interface VideoOptions {
  readonly signal: AbortSignal;
  readonly onProgress: (progress: VideoProgress) => void;
}
