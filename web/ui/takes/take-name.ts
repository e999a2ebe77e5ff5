import { el, setText } from '../widgets/dom';
import { LONGEST_NAME } from '../store/actions/takes';

/** The name of a take, as text or as a field while it is edited. */
export interface TakeName {
  readonly root: HTMLElement;
  readonly show: (title: string) => void;
  readonly edit: () => void;
}

/**
 * @param onRename is called with the new name, unless it is the old one or editing was cancelled with Escape
 * @param onLeave is called when editing was ended by key, so that the focus can be moved on
 */
export function createTakeName(onRename: (name: string) => void, onLeave: () => void): TakeName {
  const words = el('b');
  const field = el('input', {
    attributes: {
      type: 'text',
      'aria-label': 'Name of the take',
      maxlength: LONGEST_NAME,
      spellcheck: 'false',
    },
    on: {
      keydown: (event) => {
        // The shortcuts of the list and of the page do nothing while someone types.
        event.stopPropagation();
        if (event.key !== 'Enter' && event.key !== 'Escape') return;
        event.preventDefault();
        close(event.key === 'Enter');
        onLeave();
      },
      blur: () => {
        close(true);
      },
    },
  });
  field.hidden = true;

  const close = (keep: boolean): void => {
    if (field.hidden) return;
    field.hidden = true;
    words.hidden = false;
    if (keep && field.value !== words.textContent) onRename(field.value);
  };
  return {
    root: el('div', { class: 'name' }, words, field),
    show: (title) => {
      setText(words, title);
      words.title = title;
    },
    edit: () => {
      field.value = words.textContent ?? '';
      field.hidden = false;
      words.hidden = true;
      field.focus();
      field.select();
    },
  };
}
