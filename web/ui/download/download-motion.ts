import { estimateBytes, FRAME_RATES, type FrameRate, type MotionFormat } from '../../export/client';
import { chosenDance, chosenRole, fileNameParts, selectionOf } from './dance';
import { el, setText, UNTRANSLATED } from '../widgets/dom';
import { downloadChosen } from '../store/actions/download';
import { motionFileName } from './file-name';
import { byteSize } from '../store/format';
import { icon } from '../widgets/icons';
import { radioGroup } from '../widgets/radio-group';
import type { Services } from '../store/services';
import type { AppState } from '../store/state';
import { apply, type Store, watch, watchAll } from '../store/store';

const TWO_FILES = 'Zip of two skeletons in centimetres, for Blender (scale 0.01), Maya, MotionBuilder';
const FORMATS: readonly (readonly [MotionFormat, string, string])[] = [
  ['bvh', 'BVH', 'Skeleton in centimetres, for Blender (scale 0.01), Maya, MotionBuilder'],
  ['glb', 'GLB', 'Skinned mannequin with the animation, for 3D tools and web pages'],
  ['npz', 'NPZ', '22 joints in metres, for Python'],
  ['json', 'JSON', 'Joints and all settings, as text'],
];

/** What must be set by hand when a tool reads a format, because the file cannot say it. */
const IMPORT_HINTS: Partial<Record<MotionFormat, (rate: FrameRate) => string>> = {
  bvh: () => 'In centimetres: in Blender import it with scale 0.01 and “Update Scene FPS”',
  glb: (rate) => `For a scene of ${rate} frames a second in Blender, whose own is 24`,
};

/** Part of the download menu: whose motion, in which format, under which name. */
interface DownloadMotion {
  readonly parts: readonly HTMLElement[];
  /** Puts the focus on the format that was saved last. */
  readonly focus: () => void;
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
      apply(store, downloadChosen({ who: selectionOf(value, store.getState()) }));
    },
  );
  const rates = radioGroup(
    'Frames a second',
    FRAME_RATES.map((rate) => [rate, String(rate)] as const),
    (rate) => {
      apply(store, downloadChosen({ rate }));
    },
  );
  const fileName = createFileNameLine();
  /** The format under pointer or focus; its file name is shown instead of that of the format saved last. */
  let previewed: MotionFormat | null = null;
  const rows = FORMATS.map(([format, name, purpose]) =>
    createFormatRow(format, name, purpose, {
      save: () => {
        services.saveMotion(format);
      },
      preview: (on) => {
        previewed = on ? format : null;
        fileName.show(store.getState(), previewed);
      },
    }),
  );
  /** Sizes take time to estimate, so they are only shown while the menu is open. */
  const showSizes = (state: AppState): void => {
    if (state.openPanel !== 'download') return;
    const dance = chosenDance(state);
    for (const { format, showSize } of rows) {
      const size = dance ? byteSize(estimateBytes(format, dance)) : '';
      showSize(state.writing === format ? 'Writing' : size);
    }
  };
  watchAll(store, shownParts, (state) => {
    who.show(chosenRole(state));
    rates.show(state.download.rate);
    for (const row of rows) row.show(state);
    fileName.show(state, previewed);
    showSizes(state);
  });
  watch(
    store,
    (state) => state.openPanel,
    (_, state) => {
      showSizes(state);
    },
  );
  return {
    parts: [
      el('div', { class: 'row' }, el('h2', { text: 'Motion of' }), who.element),
      el('div', { class: 'row' }, el('span', { class: 'soft', text: 'Frames a second' }), rates.element),
      ...rows.map(({ button }) => button),
      fileName.root,
    ],
    focus: () => {
      const { format } = store.getState().download;
      rows.find((row) => row.format === format)?.button.focus();
    },
  };
}

/** The parts of the state that are shown. */
function shownParts(state: AppState): readonly unknown[] {
  const { reaction, takes, footLock, download, playback, writing, saved } = state;
  return [reaction, takes, footLock, download, playback.region, chosenRole(state), writing, saved];
}

/** A format: its name, what it is for and how large the file will be; a click saves it. */
interface FormatRow {
  readonly format: MotionFormat;
  readonly button: HTMLButtonElement;
  readonly show: (state: AppState) => void;
  readonly showSize: (text: string) => void;
}

function createFormatRow(
  format: MotionFormat,
  name: string,
  purpose: string,
  { save, preview }: { readonly save: () => void; readonly preview: (on: boolean) => void },
): FormatRow {
  const size = el('em');
  const purposeText = el('span', { text: purpose });
  const previewIs = (on: boolean) => (): void => {
    preview(on);
  };
  const button = el(
    'button',
    {
      class: 'menu-item',
      attributes: { type: 'button' },
      on: {
        click: save,
        pointerenter: previewIs(true),
        pointerleave: previewIs(false),
        focus: previewIs(true),
        blur: previewIs(false),
      },
    },
    el('b', { text: name, attributes: UNTRANSLATED }),
    purposeText,
    size,
  );
  return {
    format,
    button,
    show: ({ download, reaction, writing }) => {
      setText(purposeText, format === 'bvh' && download.who === 'both' ? TWO_FILES : purpose);
      button.title = IMPORT_HINTS[format]?.(download.rate) ?? '';
      button.disabled = reaction === null;
      button.classList.toggle('last', format === download.format);
      button.setAttribute('aria-busy', String(writing === format));
    },
    showSize: (text) => {
      setText(size, text);
    },
  };
}

/** The name under which a file will be saved, or was. */
function createFileNameLine(): {
  readonly root: HTMLElement;
  /** @param previewed the format whose file is meant; null means the one saved last */
  readonly show: (state: AppState, previewed: MotionFormat | null) => void;
} {
  const status = el('span');
  const nameText = el('b', { attributes: UNTRANSLATED });
  const root = el('div', { class: 'file' }, icon('check'), status, nameText);
  return {
    root,
    show: (state, previewed) => {
      const named = fileNameParts(state);
      const format = previewed ?? state.download.format;
      const name = named ? motionFileName(named, chosenRole(state), format) : '';
      const { saved } = state;
      const done = saved?.name === name;
      root.classList.toggle('saved', done);
      setText(status, done ? `Saved, ${byteSize(saved.bytes)}` : 'Will be saved as');
      setText(nameText, name);
    },
  };
}
