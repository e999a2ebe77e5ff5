import { el, setText, together } from '../widgets/dom';
import type { Mount } from '../store/services';
import { apply, watch } from '../store/store';
import { toastShown } from '../store/actions/notices';

/** How long a toast stays; a click closes it sooner. */
const TOAST_MS = 7000;

/** Toasts: a sentence about what has just happened, at the stage's upper edge. */
export const mountToast: Mount = (root, store) => {
  const words = el('span');
  const pill = el(
    'div',
    {
      class: 'float news',
      on: {
        click: () => {
          apply(store, toastShown(null));
        },
      },
    },
    words,
  );
  const spoken = el('p', { class: 'vh', attributes: { role: 'status' } });
  root.append(pill, spoken);
  let timer: ReturnType<typeof setTimeout> | undefined;
  return together(
    watch(
      store,
      (state) => state.toast,
      (toast) => {
        clearTimeout(timer);
        pill.hidden = toast === null;
        setText(words, toast ?? '');
        setText(spoken, toast ?? '');
        if (toast !== null) timer = setTimeout(() => void apply(store, toastShown(null)), TOAST_MS);
      },
    ),
    () => {
      clearTimeout(timer);
      pill.remove();
      spoken.remove();
    },
  );
};
