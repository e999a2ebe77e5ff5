/** What can be wrong with a motion file. */
export type MotionErrorCode =
  | 'empty-file'
  | 'not-bvh'
  | 'truncated'
  | 'bad-hierarchy'
  | 'bad-number'
  | 'wrong-columns'
  | 'bad-frame-time'
  | 'too-few-frames'
  | 'too-long'
  | 'several-roots'
  | 'missing-joints'
  | 'not-a-body';

/** A motion file that cannot be used: a sentence for the person who chose it, and what to do about it. */
export class MotionError extends Error {
  override readonly name = 'MotionError';
  /** One of `MotionErrorCode`, for tests and for the page. */
  readonly code: MotionErrorCode;
  /** What the person can do about it, one sentence. */
  readonly hint: string;

  /** `message` is one sentence that says what is wrong and where (line, joint). */
  constructor(code: MotionErrorCode, message: string, hint: string) {
    super(message);
    this.code = code;
    this.hint = hint;
  }
}
