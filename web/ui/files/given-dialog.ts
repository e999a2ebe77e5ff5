import { textButton } from '../widgets/button';
import { createDialogPlace } from '../widgets/dialog-place';
import { el } from '../widgets/dom';
import { givenSet } from '../store/actions/files';
import type { Mount, Services } from '../store/services';
import type { FileGroup, GivenFiles } from '../store/state';
import { apply, watch, type Store } from '../store/store';

/** The files that were given together: which song and which leader is used, and what the others are. */
export const mountGivenDialog: Mount = (root, store, services) => {
  const place = createDialogPlace(root);
  watch(
    store,
    ({ given }) => given,
    (given) => {
      if (given) place.show(build(given, store, services), 'input:checked, button');
      else place.close();
    },
  );
};

function build({ songs, leaders, unused }: GivenFiles, store: Store, services: Services): HTMLElement {
  const count = songs.length > 1 || leaders.length > 1;
  const form = el(
    'form',
    {
      class: 'float problem given',
      attributes: { role: 'dialog', 'aria-labelledby': 'given-title' },
      on: {
        submit: (event) => {
          event.preventDefault();
          const chosen = (name: string, groups: readonly FileGroup[]): FileGroup =>
            groups[Number(new FormData(form).get(name))] ?? [];
          const files = [...chosen('song', songs), ...chosen('leader', leaders)];
          apply(store, givenSet(null));
          services.useGiven(files);
        },
      },
    },
    el('h1', {
      text: count ? 'Which of these do you want to use?' : 'These files were found.',
      attributes: { id: 'given-title' },
    }),
    ...choices('Song', 'song', songs),
    ...choices('Leader', 'leader', leaders),
    ...(unused.length > 0
      ? [el('ul', { attributes: { 'aria-label': 'Not used' } }, ...unused.map((text) => el('li', { text })))]
      : []),
    el(
      'div',
      { class: 'actions' },
      el('button', { class: 'btn primary', text: useText(songs, leaders), attributes: { type: 'submit' } }),
      textButton('btn ghost', 'Cancel', () => {
        apply(store, givenSet(null));
      }),
    ),
  );
  return form;
}

/** The files of a kind, one of which is chosen; nothing without any. */
function choices(title: string, name: string, groups: readonly FileGroup[]): HTMLElement[] {
  if (groups.length === 0) return [];
  const options = groups.map(([file], index) =>
    el(
      'label',
      {},
      el('input', {
        attributes: { type: 'radio', name, value: index, ...(index === 0 && { checked: '' }) },
      }),
      el('span', { text: file?.name ?? '' }),
    ),
  );
  return [el('fieldset', {}, el('legend', { text: title }), el('div', { class: 'list' }, ...options))];
}

function useText(songs: readonly FileGroup[], leaders: readonly FileGroup[]): string {
  if (songs.length > 0 && leaders.length > 0) return 'Use song and leader';
  return songs.length > 0 ? 'Use the song' : 'Use the leader';
}
