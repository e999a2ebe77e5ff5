/** What can go wrong: the same name in tests, in the page's `data-code` and in logs. */
export type ErrorCode =
  // A file, of a motion or a song.
  | 'empty-file'
  | 'unreadable-file'
  | 'too-long'
  // An archive of files.
  | 'archive-damaged'
  | 'archive-empty'
  | 'archive-too-large'
  // A motion.
  | 'not-bvh'
  | 'not-motion'
  | 'no-motion'
  | 'missing-file'
  | 'truncated'
  | 'bad-hierarchy'
  | 'bad-number'
  | 'wrong-columns'
  | 'bad-frame-time'
  | 'too-few-frames'
  | 'missing-joints'
  | 'not-a-body'
  // A song.
  | 'not-audio'
  | 'no-sound'
  | 'bad-recipe'
  | 'playback-refused'
  // A video of a leader, and the camera that films one.
  | 'not-a-video'
  | 'sound-only'
  | 'video-codec'
  | 'video-insecure'
  | 'video-unread'
  | 'video-damaged'
  | 'video-stalled'
  | 'video-too-long'
  | 'video-too-short'
  | 'video-black'
  | 'no-person'
  | 'half-a-body'
  | 'camera-refused'
  | 'camera-stopped'
  // The model, and what is asked of it.
  | 'model-missing'
  | 'manifest-invalid'
  | 'model-unsupported'
  | 'model-corrupt'
  | 'model-mismatch'
  | 'download-failed'
  | 'web-page-instead'
  | 'gpu-lost'
  | 'bad-request'
  | 'not-finite'
  // A worker, or another part of the page.
  | 'worker-crashed'
  | 'out-of-memory'
  | 'page-part-missing'
  | 'newer-version'
  // The stage.
  | 'webgl-missing'
  | 'webgl-lost'
  // A file to save.
  | 'video-unsupported'
  | 'video-failed'
  | 'picture-failed'
  | 'sound-failed'
  // Files of a study.
  | 'not-a-study'
  | 'not-answers'
  | 'storage-refused'
  // A project file.
  | 'not-a-project'
  | 'damaged-project'
  | 'newer-project'
  | 'too-large';

/** A failure that was foreseen: what is wrong, and what the visitor can do about it. */
export class AppError extends Error {
  override readonly name = 'AppError';

  /**
   * @param message one sentence that says what is wrong and where (line, joint, file, field)
   * @param hint what the visitor can do about it, in one or two sentences
   */
  constructor(
    readonly code: ErrorCode,
    message: string,
    readonly hint: string,
    options?: ErrorOptions,
  ) {
    super(message, options);
  }
}
