/**
 * Parts of the page that are loaded when they are needed: the scripts of workers, and modules. A newer version of the
 * page, put on the server while a tab is open, has other parts under other names.
 */
import { AppError, type ErrorCode } from './error';

/** What fails in a tab whose version is no longer on the server. */
const MAY_BE_OUTDATED: readonly ErrorCode[] = [
  'page-part-missing',
  'model-missing',
  'manifest-invalid',
  'model-corrupt',
  'model-mismatch',
  'web-page-instead',
];

/** How long to wait for the server's page, milliseconds: meanwhile a failure is not reported. */
const WAIT_MS = 5000;

/** A script of the page could not be loaded. */
export function pagePartMissing(cause?: unknown): AppError {
  return new AppError(
    'page-part-missing',
    'A part of this page could not be loaded.',
    'Check the connection, then try again.',
    { cause },
  );
}

/** What a tab does not have is of a version that the server no longer has. */
export function newerVersion(cause?: unknown): AppError {
  return new AppError(
    'newer-version',
    'A newer version of this page is out, and the older one in this tab is no longer complete.',
    'Reload the page to go on with the newer version.',
    { cause },
  );
}

/**
 * Loads a module that is not needed at the start.
 * @throws {AppError} `newer-version` or `page-part-missing`
 */
export async function loadPart<Module>(load: () => Promise<Module>): Promise<Module> {
  try {
    return await load();
  } catch (error) {
    throw await explainedByVersion(pagePartMissing(error));
  }
}

/** What tells the version of a page: its document, and the server's answer to its address. */
export interface PageSource {
  readonly document: Pick<Document, 'querySelector'>;
  /** The page as the server has it now. */
  readonly current: () => Promise<Response>;
}

/** The page itself; null in a worker, whose errors the page explains. */
function ownPage(): PageSource | null {
  if (!('document' in globalThis)) return null;
  return {
    document,
    current: () => fetch(location.pathname, { cache: 'no-store', signal: AbortSignal.timeout(WAIT_MS) }),
  };
}

/** The error itself, or `newer-version` where the server has another version of the page than this one. */
export async function explainedByVersion(error: Error, page = ownPage()): Promise<Error> {
  const suspected = error instanceof AppError && MAY_BE_OUTDATED.includes(error.code);
  return suspected && page && (await isOutdated(page)) ? newerVersion(error) : error;
}

/**
 * Whether the server's page begins with another script, whose name has a hash of its content. A page without any such
 * script is not this one: a network that asks its users to sign in answers everything with its own.
 */
async function isOutdated({ document, current }: PageSource): Promise<boolean> {
  const script = document.querySelector('script[type="module"][src]')?.getAttribute('src');
  try {
    const response = await current();
    if (!response.ok || !script) return false;
    const page = await response.text();
    const anyVersion = script.replace(/[\w-]{8}\.js$/, '');
    return page.includes(anyVersion) && !page.includes(script);
  } catch {
    // Without a connection nothing is known of other versions.
    return false;
  }
}
