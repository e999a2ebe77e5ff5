import { motionFormat } from '../../motion/import/format';

/** The type of a file, from its first bytes; from its name only where they do not tell. */
export type FileKind = 'song' | 'leader' | 'video' | 'picture' | 'unknown';

/** Bytes that `fileKind` looks at. */
export const HEAD_BYTES = 512;

const VIDEO_NAME = /\.(mp4|m4v|mov|webm|mkv)$/i;
/** Videos that are no songs either, also in containers that are not read, which the reader of videos then says. */
const ONLY_VIDEO_NAME = /\.(m4v|mov|mkv|avi|wmv|mpg|mpeg|flv|3gp|mts|m2ts)$/i;
const PROJECT_NAME = /\.reactdance(\.zip)?$/i;

/** Whether a file is a video, from its name alone: a leader that was read from one keeps its name. */
export function isVideoName(name: string): boolean {
  return VIDEO_NAME.test(name) || ONLY_VIDEO_NAME.test(name);
}

/** Whether a file is a project, from its name alone: other files are zip archives too. */
export function isProject(name: string): boolean {
  return PROJECT_NAME.test(name);
}

/** How files of a kind are told from others: by their first bytes, as text and as numbers, or else by name or media type. */
interface Signature {
  readonly kind: FileKind;
  readonly head: (text: string, head: Uint8Array, name: string, type: string) => boolean;
  readonly name?: RegExp;
  readonly type?: string;
}

/** The first one that fits counts. */
const SIGNATURES: readonly Signature[] = [
  { kind: 'picture', head: isPicture, type: 'image/' },
  // The same containers hold songs: whether there are pictures in it is seen when it is opened.
  {
    kind: 'video',
    head: (text, _, name, type) => isContainer(text) && (type.startsWith('video/') || VIDEO_NAME.test(name)),
    name: ONLY_VIDEO_NAME,
    type: 'video/',
  },
  {
    kind: 'song',
    head: isSound,
    name: /\.(mp3|wav|wave|ogg|oga|opus|flac|m4a|mp4|aac|webm|weba|aif|aiff)$/i,
    type: 'audio/',
  },
  { kind: 'leader', head: (_, head, name) => motionFormat(head, name) !== null },
];

/**
 * @param head the first `HEAD_BYTES` bytes, or all of a shorter file
 * @param name the file's name
 * @param type the browser's guess of its media type
 */
export function fileKind(head: Uint8Array, name: string, type: string): FileKind {
  const text = String.fromCharCode(...head);
  const known =
    SIGNATURES.find((signature) => signature.head(text, head, name, type)) ??
    // The bytes do not tell: the reader of the type that the name suggests reports what is wrong with them.
    SIGNATURES.find(
      (signature) =>
        signature.name?.test(name) === true ||
        (signature.type !== undefined && type.startsWith(signature.type)),
    );
  return known?.kind ?? 'unknown';
}

/** PNG, JPEG, GIF, WebP, and HEIC or AVIF, which lie in the same container as sounds. */
function isPicture(text: string): boolean {
  if (/^(\u0089PNG|\u00ff\u00d8\u00ff|GIF8)/.test(text)) return true;
  return /^RIFF[^]{4}WEBP|^[^]{4}ftyp(hei|hev|mif|msf|avi)/.test(text);
}

function isSound(text: string, head: Uint8Array): boolean {
  if (/^(ID3|OggS|fLaC)/.test(text)) return true;
  if (text.startsWith('RIFF') && text.slice(8, 12) === 'WAVE') return true;
  if (text.startsWith('FORM') && text.slice(8, 11) === 'AIF') return true;
  if (isContainer(text)) return true;
  // MPEG audio and ADTS start with eleven set bits; 0xff 0xfe is a UTF-16 byte order mark instead.
  return head[0] === 0xff && ((head[1] ?? 0) & 0xe0) === 0xe0 && (head[1] ?? 0) < 0xfe;
}

/** MP4 and MOV, or Matroska and WebM. */
function isContainer(text: string): boolean {
  return text.slice(4, 8) === 'ftyp' || text.startsWith('\u001aE\u00df\u00a3');
}
