import { estimateBytes, type MotionFormat } from '../../export/client';
import { danceOf, namedAfter } from './dance';
import { el, setText, together } from '../widgets/dom';
import { downloadChosen } from '../store/actions/download';
import { motionFileName } from './file-name';
import { byteSize } from '../store/format';
import { icon } from '../widgets/icons';
import { radioGroup } from '../widgets/radio-group';
import type { Services } from '../store/services';
import type { AppState } from '../store/state';
import { apply, type Store, watch, watchAll } from '../store/store';

const TWO_FILES = 'Two skeletons with rest pose in a zip, for Blender, Maya, MotionBuilder';
const FORMATS: readonly (readonly [MotionFormat, string, string])[] = [
  ['bvh', 'BVH', 'Skeleton with rest pose, for Blender, Maya, MotionBuilder'],
  ['glb', 'GLB', 'Skinned mannequin with the animation, for 3D tools and web pages'],
  ['npz', 'NPZ', '22 joints in metres, 30 fps, for Python'],
  ['json', 'JSON', 'Joints with all settings, readable'],
];

/** What a tool has to be told when it reads a format, where the file cannot say it itself. */
const READING: Partial<Record<MotionFormat, string>> = {
  bvh: 'In centimetres: in Blender import it with scale 0.01 and “Update Scene FPS”',
};

/** Part of the download menu: whose motion, in which format, under which name. */
export interface DownloadMotion {
  readonly parts: readonly HTMLElement[];
  /** Puts the focus on the format that was saved last. */
  readonly focus: () => void;
  readonly dispose: () => void;
}

export function createDownloadMotion(store: Store, services: Services): DownloadMotion {
  const who = radioGroup(
    'Motion of',
    [
      ['reactor', 'Reactor'],
      ['leader', 'Leader'],
      ['both', 'Both'],
    ],
    (value) => {
      apply(store, downloadChosen({ who: value }));
    },
  );
  /** The format whose file name is shown while pointer or focus is on it; else the last one saved. */
  let looked: MotionFormat | null = null;
  const look = (format: MotionFormat | null) => (): void => {
    looked = format;
    showName(store.getState());
  };
  const rows = FORMATS.map(([format, name, purpose]) => {
    const size = el('em');
    const words = el('span', { text: purpose });
    const button = el(
      'button',
      {
        class: 'it',
        attributes: { type: 'button', title: READING[format] },
        on: {
          click: () => {
            services.saveMotion(format);
          },
          pointerenter: look(format),
          pointerleave: look(null),
          focus: look(format),
          blur: look(null),
        },
      },
      el('b', { text: name }),
      words,
      size,
    );
    return { format, button, size, words, purpose };
  });
  const fileState = el('span');
  const fileName = el('b');
  const file = el('div', { class: 'file' }, icon('check'), fileState, fileName);

  const showName = (state: AppState): void => {
    const named = namedAfter(state);
    const { who: whose, format } = state.download;
    const name = named ? motionFileName(named, whose, looked ?? format) : '';
    const { saved } = state;
    const done = saved?.name === name;
    file.classList.toggle('saved', done);
    setText(fileState, done ? `Saved, ${byteSize(saved.bytes)}` : 'Will be saved as');
    setText(fileName, name);
  };
  const show = (state: AppState): void => {
    who.show(state.download.who);
    for (const { format, button, words, purpose } of rows) {
      setText(words, format === 'bvh' && state.download.who === 'both' ? TWO_FILES : purpose);
      button.disabled = state.reaction === null;
      button.classList.toggle('last', format === state.download.format);
      button.setAttribute('aria-busy', String(state.writing === format));
    }
    showName(state);
  };
  /** Sizes cost a little to know and are only asked for when someone looks. */
  const showSizes = (state: AppState): void => {
    if (state.openPanel !== 'download') return;
    const dance = danceOf(state, state.download.who);
    for (const { format, size } of rows) {
      const writing = state.writing === format;
      setText(size, writing ? 'Writing' : dance ? byteSize(estimateBytes(format, dance)) : '');
    }
  };
  return {
    parts: [
      el('div', { class: 'row' }, el('h2', { text: 'Motion of' }), who.element),
      ...rows.map(({ button }) => button),
      file,
    ],
    focus: () => {
      const { format } = store.getState().download;
      rows.find((row) => row.format === format)?.button.focus();
    },
    dispose: together(
      watchAll(
        store,
        (state) => [state.reaction, state.footLock, state.download, state.writing, state.saved],
        (state) => {
          show(state);
          showSizes(state);
        },
      ),
      watch(
        store,
        (state) => state.openPanel,
        (_, state) => {
          showSizes(state);
        },
      ),
    ),
  };
}
