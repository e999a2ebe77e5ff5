import { AppError } from '../../common/error';
import type { Problem, InputKind } from './state';

/** True for the error of an abort signal, which is not shown. */
export function isAbort(error: unknown): boolean {
  return error instanceof Error && error.name === 'AbortError';
}

/**
 * A failure in its own words where it was foreseen, else in those of `unforeseen`. Where the server has a newer version of
 * the page, without which this one cannot go on, the remedy is to reload it.
 */
function problemOf(
  error: unknown,
  unforeseen: Pick<Problem, 'code' | 'title' | 'hint'>,
  remedy: Problem['remedy'],
): Problem {
  const { code, title, hint } =
    error instanceof AppError ? { code: error.code, title: error.message, hint: error.hint } : unforeseen;
  return { code, title, hint, remedy: code === 'newer-version' ? 'reload' : remedy, refused: null };
}

/** Failures of the page that no other file would mend; the models are those that find a dancer in a video. */
const NOT_OF_THE_FILE: readonly string[] = [
  'worker-crashed',
  'out-of-memory',
  'page-part-missing',
  'download-failed',
  'web-page-instead',
  'model-missing',
  'model-corrupt',
];

/** A failure while a file was read. */
export function fileProblem(error: unknown, kind: InputKind, name: string): Problem {
  const problem = problemOf(
    error,
    {
      code: 'unreadable-file',
      title: `${name} could not be read.`,
      hint: 'Choose it again, or try another file. Everything loaded before is unchanged.',
    },
    kind,
  );
  if (problem.remedy === 'reload') return problem;
  const refused = { kind, name };
  if (NOT_OF_THE_FILE.includes(problem.code)) return { ...problem, remedy: 'read-again', refused };
  return { ...problem, title: named(name, problem.title), refused };
}

/** A leader that ships with the page could not be loaded. */
export function offeredProblem(name: string): Problem {
  return {
    code: 'page-part-missing',
    title: `“${name}” could not be loaded from this page’s server.`,
    hint: 'Check the connection, then choose it again. Everything loaded before is unchanged.',
    remedy: 'none',
    refused: null,
  };
}

/** Puts the file's name before a sentence that does not contain it. */
function named(name: string, sentence: string): string {
  return sentence.includes(name) ? sentence : `${name}: ${sentence}`;
}

/** A project file that could not be opened, or written. */
export function projectProblem(error: unknown, name: string, remedy: Problem['remedy']): Problem {
  const problem = problemOf(
    error,
    {
      code: 'unreadable-file',
      title: `${name} could not be read.`,
      hint: 'Choose it again. Everything on the page is unchanged.',
    },
    remedy,
  );
  return { ...problem, title: named(name, problem.title), refused: { kind: null, name } };
}

/** An opened project in which there is no leader. */
export function leaderlessProblem(name: string): Problem {
  return {
    code: 'no-leader',
    title: `${name} came without a leader that can be read.`,
    hint: 'Its song is here. Choose the leader’s video or motion file, and a partner is made again.',
    remedy: 'leader',
    refused: null,
  };
}

/** The browser has no more space for autosave. */
export function fullProblem(): Problem {
  return {
    code: 'storage-full',
    title: 'The space that this browser has for the page is full.',
    hint:
      'Everything is still here, but what does not fit is lost when the page is closed. Delete takes that you don’t need, ' +
      'or free space on this device: the rest is then kept automatically. Or save a project file.',
    remedy: 'project',
    refused: null,
  };
}

/** A failure while the model was loaded. */
export function modelProblem(error: unknown): Problem {
  return problemOf(
    error,
    {
      code: 'model-failed',
      title: 'The model could not be started.',
      hint: 'Reload the page; if it happens again, try another browser.',
    },
    'model',
  );
}

/** A failure while the visitor's own model was opened; the present one stays. */
export function ownModelProblem(error: unknown): Problem {
  const problem = modelProblem(error);
  return problem.remedy === 'model' ? { ...problem, remedy: 'own-model' } : problem;
}

/** A failure while a reaction was generated. */
export function generationProblem(error: unknown): Problem {
  return problemOf(
    error,
    {
      code: 'generation-failed',
      title: 'The partner could not be made.',
      hint: 'Try again; a shorter leader needs less memory.',
    },
    'generate',
  );
}

/** A failure to decode the coarse layer of a reaction that is there. */
export function coarseProblem(error: unknown): Problem {
  return problemOf(
    error,
    {
      code: 'coarse-failed',
      title: 'The coarse layer of this reaction could not be shown.',
      hint: 'Show it again, or generate the reaction again.',
    },
    'generate',
  );
}

/** A failure to play. */
export function playbackProblem(error: unknown): Problem {
  return problemOf(
    error,
    {
      code: 'playback-failed',
      title: 'The song could not be played.',
      hint: 'Press play again.',
    },
    'none',
  );
}

/** A failure to write a download. */
export function savingProblem(error: unknown): Problem {
  return problemOf(
    error,
    {
      code: 'saving-failed',
      title: 'The file could not be written.',
      hint: 'Try again, or another format. The dance and your settings are unchanged.',
    },
    'none',
  );
}

/** A failure of the 3D view; everything else goes on working. */
export function stageProblem(error: unknown): Problem {
  return problemOf(
    error,
    {
      code: 'stage-failed',
      title: 'The 3D view could not be started.',
      hint: 'Turn on hardware acceleration in the browser. Generating and downloading still work.',
    },
    'none',
  );
}

/** What was dropped could not be opened at all: moved in the meantime, forbidden, or on a disk that was removed. */
export function dropProblem(error: unknown): Problem {
  const forbidden =
    error instanceof DOMException && (error.name === 'NotReadableError' || error.name === 'SecurityError');
  return {
    code: 'drop-unreadable',
    title: forbidden
      ? 'The browser is not allowed to read what was dropped.'
      : 'Not everything that was dropped could be read.',
    hint: 'Check that it is still there and that you may open it, copy it to a folder of your own, and drop it again.',
    remedy: 'any-file',
    refused: null,
  };
}

/** An archive could not be unpacked. */
export function archiveProblem(error: unknown): Problem {
  return problemOf(
    error,
    {
      code: 'unreadable-file',
      title: 'The archive could not be read.',
      hint: 'Unpack it and choose a file from it. Everything loaded before is unchanged.',
    },
    'any-file',
  );
}

export function emptyDropProblem(): Problem {
  return {
    code: 'drop-empty',
    title: 'Nothing that was dropped is a file.',
    hint: 'Drop a song, a leader’s video or motion file, or the folder of a model with its manifest.json.',
    remedy: 'any-file',
    refused: null,
  };
}

const USABLE =
  'A song is an mp3, wav, ogg, flac, m4a or opus file; a leader is a video or a motion file: BVH, FBX, ' +
  'glTF, VRMA, VMD, AMC with ASF, C3D, NPZ, NPY, JSON, CSV or TRC.';

/** What is to be done with files of motions that are not read, by their endings. */
const OTHER_MOTIONS: readonly (readonly [RegExp, string])[] = [
  [/\.(rar|7z|tar|t?gz)$/i, 'Unpack it and choose a file from it. '],
  [
    /\.(pkl|pickle|pt|pth)$/i,
    'A pickle may hold a program and is not opened here: load it in Python and save its arrays, such as smpl_poses and smpl_trans, with numpy.savez. ',
  ],
  [/\.(mot|sto|osim)$/i, 'It belongs to a model of OpenSim: choose the TRC of its markers. '],
  [/\.tak$/i, 'Export the take in Motive as BVH, FBX or CSV. '],
  [/\.(blend|ma|mb|max|c4d|uasset|unitypackage|iclone|duf)$/i, 'Export its animation as FBX, glTF or BVH. '],
];

export function unknownFileProblem(name: string): Problem {
  const instead = OTHER_MOTIONS.find(([ending]) => ending.test(name))?.[1] ?? '';
  return {
    code: 'unknown-file',
    title: `${name} is neither a song, a video nor a motion.`,
    hint: instead + USABLE,
    remedy: 'any-file',
    refused: { kind: null, name },
  };
}

/** None of several files can be used. `sentences` say what they are. */
export function noneUsableProblem(count: number, sentences: readonly string[]): Problem {
  return {
    code: 'none-usable',
    title: `None of the ${count} files is a song or a leader.`,
    hint: `${sentences.join(' ')} ${USABLE}`,
    remedy: 'any-file',
    refused: null,
  };
}

export function emptyFileProblem(name: string): Problem {
  return {
    code: 'empty-file',
    title: `${name} is empty.`,
    hint: 'The copy or download may have failed. Copy or download it again.',
    remedy: 'any-file',
    refused: { kind: null, name },
  };
}
