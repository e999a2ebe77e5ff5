/** What can go wrong between a model on the server and a partner on the page. */
export type ModelErrorCode =
  | 'model-missing'
  | 'manifest-invalid'
  | 'model-unsupported'
  | 'model-corrupt'
  | 'model-mismatch'
  | 'download-failed'
  | 'bad-request'
  | 'not-finite'
  | 'worker-crashed';

/** A model that cannot be loaded or run: a sentence for the person at the page, and what to do about it. */
export class ModelError extends Error {
  override readonly name = 'ModelError';
  /** For tests and for the page. */
  readonly code: ModelErrorCode;
  /** What the person can do about it, one sentence. */
  readonly hint: string;

  /** `message` is one sentence that says what is wrong and where (file, field). */
  constructor(code: ModelErrorCode, message: string, hint: string, options?: ErrorOptions) {
    super(message, options);
    this.code = code;
    this.hint = hint;
  }
}
