import { el, setText, UNTRANSLATED } from '../widgets/dom';
import { MAX_TAKE_NAME_LENGTH } from '../store/actions/takes';

/** The name of a take, as text or as a field while it is edited. */
interface TakeName {
  readonly root: HTMLElement;
  readonly show: (title: string) => void;
  readonly edit: () => void;
}

/**
 * @param onRename is called with the new name, unless it is the old one or editing was cancelled with Escape
 * @param onLeave is called when editing was ended by key, so that the focus can be moved on
 */
export function createTakeName(onRename: (name: string) => void, onLeave: () => void): TakeName {
  // Not read back from the page, where a translation may have replaced it.
  let shown = '';
  const text = el('b', { attributes: UNTRANSLATED });
  const field = el('input', {
    attributes: {
      type: 'text',
      'aria-label': 'Name of the take',
      maxlength: MAX_TAKE_NAME_LENGTH,
      spellcheck: 'false',
    },
    on: {
      keydown: (event) => {
        // The shortcuts of the list and of the page do nothing while someone types.
        event.stopPropagation();
        if (event.key !== 'Enter' && event.key !== 'Escape') return;
        // There they choose what an input method offers.
        if (event.isComposing) return;
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
    text.hidden = false;
    if (keep && field.value !== shown) onRename(field.value);
  };
  return {
    root: el('div', { class: 'name' }, text, field),
    show: (title) => {
      shown = title;
      setText(text, title);
      text.title = title;
    },
    edit: () => {
      field.value = shown;
      field.hidden = false;
      text.hidden = true;
      field.focus();
      field.select();
    },
  };
}
