/** Why something could not be written. */
export type ExportErrorCode = 'nothing-to-write' | 'video-unsupported' | 'video-failed' | 'sound-failed';

/** A failure to write a file, in words: what is wrong, and what to do about it. */
export class ExportError extends Error {
  constructor(
    readonly code: ExportErrorCode,
    message: string,
    readonly hint: string,
    options?: ErrorOptions,
  ) {
    super(message, options);
    this.name = 'ExportError';
  }
}
