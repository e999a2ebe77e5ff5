import { MOTION_ENDINGS } from '../../motion/import/format';
import type { FileChoice } from '../store/services';

const VIDEOS = 'video/*,.mov,.mkv';
/** A video chosen as the song gives its sound. */
const SONGS = `audio/*,.mp3,.wav,.ogg,.oga,.opus,.flac,.m4a,.aac,.webm,${VIDEOS}`;

/** What the system's file chooser offers; the type is decided by the file's content. */
const ACCEPT = {
  song: SONGS,
  leader: `${MOTION_ENDINGS},${VIDEOS},.zip`,
  any: `${SONGS},${MOTION_ENDINGS},.reactdance,.zip`,
  project: '.reactdance,.zip',
} as const;

/** Opens the system's file chooser through hidden inputs, one for each kind of file. */
export function createFileChooser(
  host: HTMLElement,
  open: (files: readonly File[], what: FileChoice) => void,
): (what: FileChoice) => void {
  const inputs = new Map<FileChoice, HTMLInputElement>();
  for (const what of ['song', 'leader', 'any', 'project'] as const) {
    const input = document.createElement('input');
    input.type = 'file';
    input.id = `choose-${what}`;
    input.hidden = true;
    input.accept = ACCEPT[what];
    // A leader may be two files: an AMC and its ASF.
    input.multiple = what === 'any' || what === 'leader';
    input.addEventListener('change', () => {
      const files = [...(input.files ?? [])];
      // So that choosing the same file again is a change.
      input.value = '';
      if (files.length > 0) open(files, what);
    });
    host.append(input);
    inputs.set(what, input);
  }
  return (what) => inputs.get(what)?.click();
}
