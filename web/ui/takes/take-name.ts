import { el, setText } from '../widgets/dom';
import { LONGEST_NAME } from '../store/actions/takes';

/** The name of a take, which turns into a field and back. */
export interface TakeName {
  readonly root: HTMLElement;
  readonly show: (title: string) => void;
  readonly edit: () => void;
}

/**
 * @param named hears the new name; not called when it is the old one or the visitor thinks better of it
 * @param left the field was left by key, so that the focus has nowhere to be
 */
export function createTakeName(named: (name: string) => void, left: () => void): TakeName {
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
        // The keys of the list and of the page rest while someone types.
        event.stopPropagation();
        if (event.key !== 'Enter' && event.key !== 'Escape') return;
        event.preventDefault();
        close(event.key === 'Enter');
        left();
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
    if (keep && field.value !== words.textContent) named(field.value);
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
