import { motionFormat } from '../../motion/import/format';

/** The type of a file, from its first bytes; from its name only where they do not tell. */
type FileKind = 'song' | 'leader' | 'unknown';

/** Bytes that `fileKind` looks at. */
export const HEAD_BYTES = 512;

const AUDIO_NAME = /\.(mp3|wav|wave|ogg|oga|opus|flac|m4a|mp4|aac|webm|weba|aif|aiff)$/i;
const PROJECT_NAME = /\.reactdance(\.zip)?$/i;

/** Whether a file is a project, from its name alone: other files are zip archives too. */
export function isProject(name: string): boolean {
  return PROJECT_NAME.test(name);
}

/**
 * @param head the first `HEAD_BYTES` bytes, or all of a shorter file
 * @param name the file's name
 * @param type the browser's guess of its media type
 */
export function fileKind(head: Uint8Array, name: string, type: string): FileKind {
  const text = String.fromCharCode(...head);
  if (isSound(text, head)) return 'song';
  // Where the bytes do not tell, the reader of the type that the name suggests reports what is wrong with them.
  if (motionFormat(head, name)) return 'leader';
  if (type.startsWith('audio/') || AUDIO_NAME.test(name)) return 'song';
  return 'unknown';
}

function isSound(text: string, head: Uint8Array): boolean {
  if (/^(ID3|OggS|fLaC)/.test(text)) return true;
  if (text.startsWith('RIFF') && text.slice(8, 12) === 'WAVE') return true;
  if (text.startsWith('FORM') && text.slice(8, 11) === 'AIF') return true;
  if (text.slice(4, 8) === 'ftyp' || text.startsWith('\u001aE\u00df\u00a3')) return true;
  // MPEG audio and ADTS start with eleven set bits; 0xff 0xfe is a UTF-16 byte order mark instead.
  return head[0] === 0xff && ((head[1] ?? 0) & 0xe0) === 0xe0 && (head[1] ?? 0) < 0xfe;
}
