/** What can be wrong with a project file. */
export type ProjectErrorCode =
  'not-a-project' | 'damaged-project' | 'newer-project' | 'missing-part' | 'too-large';

/** A project file that cannot be opened: a sentence for the person who chose it, and what to do about it. */
export class ProjectError extends Error {
  override readonly name = 'ProjectError';

  /** `message` is one sentence that says what is wrong and where. */
  constructor(
    readonly code: ProjectErrorCode,
    message: string,
    /** What the person can do about it, one sentence. */
    readonly hint: string,
  ) {
    super(message);
  }
}
