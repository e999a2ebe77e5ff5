import { el, setText } from '../widgets/dom';
import type { Mount } from '../store/services';
import { apply, watch } from '../store/store';
import { toastShown } from '../store/actions/notices';

/** How long a toast stays; a click closes it sooner. */
const TOAST_MS = 7000;

/** Toasts: a sentence about what has just happened, at the stage's upper edge. */
export const mountToast: Mount = (root, store) => {
  const text = el('span');
  const box = el(
    'div',
    {
      class: 'float toast',
      on: {
        click: () => {
          apply(store, toastShown(null));
        },
      },
    },
    text,
  );
  const spoken = el('p', { class: 'visually-hidden', attributes: { role: 'status' } });
  root.append(box, spoken);
  let timer: ReturnType<typeof setTimeout> | undefined;
  watch(
    store,
    (state) => state.toast,
    (toast) => {
      clearTimeout(timer);
      box.hidden = toast === null;
      setText(text, toast?.text ?? '');
      // A new text even where it is the same: screen readers read out what is added.
      spoken.replaceChildren(toast?.text ?? '');
      if (toast !== null) timer = setTimeout(() => void apply(store, toastShown(null)), TOAST_MS);
    },
  );
};
