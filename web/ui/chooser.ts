import type { Side } from './state';

/** What the system's file chooser offers first; the content decides in the end. */
const ACCEPT = {
  song: 'audio/*,.mp3,.wav,.ogg,.oga,.opus,.flac,.m4a,.aac,.webm',
  leader: '.bvh',
  any: 'audio/*,.mp3,.wav,.ogg,.oga,.opus,.flac,.m4a,.aac,.webm,.bvh',
} as const;

/** Opens the system's file chooser through inputs that live in the page, one for each kind. */
export function createChooser(
  host: HTMLElement,
  open: (files: readonly File[]) => void,
): (side: Side | 'any') => void {
  const inputs = new Map<Side | 'any', HTMLInputElement>();
  for (const side of ['song', 'leader', 'any'] as const) {
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
  return (side) => inputs.get(side)?.click();
}
