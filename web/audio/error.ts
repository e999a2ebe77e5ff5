export type AudioErrorCode =
  | 'empty-file'
  | 'unreadable-file'
  | 'not-audio'
  | 'no-sound'
  | 'too-long'
  | 'bad-recipe'
  | 'worker-crashed'
  | 'playback-refused';

/** A failure around songs: what was wrong in one sentence, and what to do about it. */
export class AudioError extends Error {
  constructor(
    readonly code: AudioErrorCode,
    message: string,
    readonly hint: string,
    options?: ErrorOptions,
  ) {
    super(message, options);
    this.name = 'AudioError';
  }
}
