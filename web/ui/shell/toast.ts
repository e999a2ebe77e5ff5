import { el, setText, together } from '../widgets/dom';
import type { Mount } from '../store/services';
import { apply, watch } from '../store/store';
import { toastShown } from '../store/actions/notices';

/** How long news stay, milliseconds; a click puts them away sooner. */
const TOAST_MS = 7000;

/** What has just happened that is not to be seen at once, in a pill at the stage's upper edge. */
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
      (news) => {
        clearTimeout(timer);
        pill.hidden = news === null;
        setText(words, news ?? '');
        setText(spoken, news ?? '');
        if (news !== null) timer = setTimeout(() => void apply(store, toastShown(null)), TOAST_MS);
      },
    ),
    () => {
      clearTimeout(timer);
      pill.remove();
      spoken.remove();
    },
  );
};
