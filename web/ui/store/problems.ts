import { AppError } from '../../common/error';
import type { Problem, Side } from './state';

/** True for the error that an abort signal leaves behind, which is nobody's problem. */
export function isAbort(error: unknown): boolean {
  return error instanceof Error && error.name === 'AbortError';
}

/** The words of a foreseen error, or those given for any other. */
function described(
  error: unknown,
  unforeseen: Pick<Problem, 'code' | 'title' | 'hint'>,
): Pick<Problem, 'code' | 'title' | 'hint'> {
  return error instanceof AppError
    ? { code: error.code, title: error.message, hint: error.hint }
    : unforeseen;
}

/** A failure while a file was read. */
export function fileProblem(error: unknown, side: Side, name: string): Problem {
  const refused = { side, name };
  if (error instanceof AppError)
    return { code: error.code, title: named(name, error.message), hint: error.hint, remedy: side, refused };
  return {
    code: 'unreadable-file',
    title: `${name} could not be read.`,
    hint: 'Choose it again, or try another file. Everything loaded before is unchanged.',
    remedy: side,
    refused,
  };
}

/** Error sentences speak of "the file" or not at all of it; the page's names it. */
function named(name: string, sentence: string): string {
  return sentence.includes(name) ? sentence : `${name}: ${sentence}`;
}

/** A project file that could not be opened, or written. */
export function projectProblem(error: unknown, name: string, remedy: Problem['remedy']): Problem {
  const told = error instanceof AppError;
  return {
    code: told ? error.code : 'unreadable-file',
    title: told ? named(name, error.message) : `${name} could not be read.`,
    hint: told ? error.hint : 'Choose it again. Everything on the page is unchanged.',
    remedy,
    refused: { side: null, name },
  };
}

/** The browser has no more space for what is made here. */
export function fullProblem(): Problem {
  return {
    code: 'storage-full',
    title: 'The space that this browser has for the page is full.',
    hint:
      'All is still here, but what does not fit is lost when the page is closed. Delete takes that you don’t need, ' +
      'or free space on this device: the rest is then kept by itself. Or save a project file.',
    remedy: 'project',
    refused: null,
  };
}

/** A failure while the model was loaded. */
export function modelProblem(error: unknown): Problem {
  return {
    ...described(error, {
      code: 'model-failed',
      title: 'The model could not be started.',
      hint: 'Reload the page; if it happens again, try another browser.',
    }),
    remedy: 'model',
    refused: null,
  };
}

/** A failure while a reaction was made. */
export function generationProblem(error: unknown): Problem {
  return {
    ...described(error, {
      code: 'generation-failed',
      title: 'The reactor could not be made.',
      hint: 'Try again; fewer steps or a shorter leader need less memory.',
    }),
    remedy: 'generate',
    refused: null,
  };
}

/** A failure to decode the coarse layer of a reaction that is there. */
export function coarseProblem(error: unknown): Problem {
  return {
    ...described(error, {
      code: 'coarse-failed',
      title: 'The coarse layer of this reaction could not be decoded.',
      hint: 'Show it again, or generate the reaction again.',
    }),
    remedy: 'generate',
    refused: null,
  };
}

/** A failure to play. */
export function playbackProblem(error: unknown): Problem {
  return {
    ...described(error, {
      code: 'playback-failed',
      title: 'The song could not be played.',
      hint: 'Press play again.',
    }),
    remedy: 'none',
    refused: null,
  };
}

/** A failure to write a file to take home. */
export function savingProblem(error: unknown): Problem {
  return {
    ...described(error, {
      code: 'saving-failed',
      title: 'The file could not be written.',
      hint: 'Try again, or another format. The dance and your settings are unchanged.',
    }),
    remedy: 'none',
    refused: null,
  };
}

/** A failure of the picture; all else goes on working. */
export function stageProblem(error: unknown): Problem {
  return {
    ...described(error, {
      code: 'stage-failed',
      title: 'The 3D picture could not be started.',
      hint: 'Turn on hardware acceleration in the browser. Generating and downloading still work.',
    }),
    remedy: 'none',
    refused: null,
  };
}

/** What was dropped could not be opened at all: moved meanwhile, forbidden, or on a disk that is gone. */
export function dropProblem(error: unknown): Problem {
  const forbidden =
    error instanceof DOMException && (error.name === 'NotReadableError' || error.name === 'SecurityError');
  return {
    code: 'drop-unreadable',
    title: forbidden
      ? 'The browser may not read what was dropped.'
      : 'What was dropped could not be read to its end.',
    hint: 'Check that it is still there and that you may open it, copy it to a folder of your own, and drop it again.',
    remedy: 'any-file',
    refused: null,
  };
}

export function emptyDropProblem(): Problem {
  return {
    code: 'drop-empty',
    title: 'There is no file in what was dropped.',
    hint: 'Drop a song, a leader as BVH, or the folder of a model with its manifest.json.',
    remedy: 'any-file',
    refused: null,
  };
}

export function otherMotionProblem(name: string): Problem {
  return {
    code: 'other-motion',
    title: `${name} is a motion in a format that cannot be read here.`,
    hint: 'Export it as BVH: Blender, MotionBuilder, Mixamo converters and most capture tools can.',
    remedy: 'leader',
    refused: { side: null, name },
  };
}

export function unknownFileProblem(name: string): Problem {
  return {
    code: 'unknown-file',
    title: `${name} is neither a song nor a motion.`,
    hint: 'A song is an mp3, wav, ogg, flac, m4a or opus file; a leader is a BVH file.',
    remedy: 'any-file',
    refused: { side: null, name },
  };
}

export function emptyFileProblem(name: string): Problem {
  return {
    code: 'empty-file',
    title: `${name} is empty.`,
    hint: 'The file has no bytes; the copy or download may have failed. Choose it again from its source.',
    remedy: 'any-file',
    refused: { side: null, name },
  };
}
