/** Something the stage cannot do on this machine, said for the person in front of it. */
export class ViewError extends Error {
  /** Kebab-case name of what went wrong, for programs. */
  readonly code: string;
  /** What the person can do about it. */
  readonly hint: string;

  constructor(code: string, message: string, hint: string) {
    super(message);
    this.name = 'ViewError';
    this.code = code;
    this.hint = hint;
  }
}
