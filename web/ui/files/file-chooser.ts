import type { FileChoice } from '../store/services';

/** What the system's file chooser offers first; the content decides in the end. */
const ACCEPT = {
  song: 'audio/*,.mp3,.wav,.ogg,.oga,.opus,.flac,.m4a,.aac,.webm',
  leader: '.bvh',
  any: 'audio/*,.mp3,.wav,.ogg,.oga,.opus,.flac,.m4a,.aac,.webm,.bvh,.reactdance',
  project: '.reactdance,.zip',
} as const;

/** Opens the system's file chooser through inputs that live in the page, one for each kind. */
export function createFileChooser(
  host: HTMLElement,
  open: (files: readonly File[]) => void,
): (what: FileChoice) => void {
  const inputs = new Map<FileChoice, HTMLInputElement>();
  for (const side of ['song', 'leader', 'any', 'project'] as const) {
    const input = document.createElement('input');
    input.type = 'file';
    input.id = `choose-${side}`;
    input.hidden = true;
    input.accept = ACCEPT[side];
    input.multiple = side === 'any';
    input.addEventListener('change', () => {
      const files = [...(input.files ?? [])];
      // Choosing the same file again must count as a choice.
      input.value = '';
      if (files.length > 0) open(files);
    });
    host.append(input);
    inputs.set(side, input);
  }
  return (what) => inputs.get(what)?.click();
}
