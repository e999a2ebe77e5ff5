import { el } from '../widgets/dom';
import { type Control, createFader, type FaderNote, type FaderTexts } from '../widgets/fader';
import type { FaderRange } from '../widgets/fader-input';
import { columnOf, rangeOf } from '../store/guidance-matrix';
import type { Guidance, Layer } from '../store/reaction';
import type { AppState } from '../store/state';
import {
  clickContinued,
  guidanceReset,
  guidanceSet,
  musicReset,
  musicSet,
  varietyReset,
  varietySet,
} from '../store/actions/settings';
import { apply, type Change, type Store } from '../store/store';

/** What a fader shows. */
interface Shown {
  /** Null disables it. */
  readonly range: FaderRange | null;
  readonly value: number;
  readonly note: FaderNote;
}

/** A fader and what it moves. */
interface Moved extends FaderTexts {
  readonly control: Control;
  readonly shown: (state: AppState) => Shown;
  /** @param beforeDrag the matrix at the start of a drag, while it lasts */
  readonly set: (value: number, beforeDrag: Guidance | undefined) => Change;
  readonly reset: () => Change;
}

const FADERS: readonly Moved[] = [
  layerFader('coarse', 'Coarse', 'Path and poses'),
  layerFader('fine', 'Fine', 'Sharpness of accents'),
  {
    control: 'music',
    name: 'Music',
    label: 'Music guidance',
    hint: 'How much the song shapes the dance',
    shown: ({ settings, manifest, song, reading, restoring }) => ({
      range: settings && manifest && song ? manifest.guidance.music : null,
      value: settings?.music ?? 0,
      note: settings && !song && !reading.song && !restoring ? 'no song' : null,
    }),
    set: musicSet,
    reset: musicReset,
  },
  {
    control: 'variety',
    name: 'Variety',
    label: 'Variety',
    hint: 'How far this seed is from the average of several',
    shown: ({ settings, manifest }) => ({
      range: settings && manifest ? manifest.guidance.variety : null,
      value: settings?.variety ?? 0,
      note: null,
    }),
    set: varietySet,
    reset: varietyReset,
  },
];

/** A fader of one layer: it moves the mean over the body parts, which keep their differences. */
function layerFader(layer: Layer, name: string, hint: string): Moved {
  return {
    control: layer,
    name,
    label: `${name} guidance`,
    hint,
    shown: ({ settings, manifest }) => {
      const { value, mixed } = columnOf(settings?.guidance ?? {}, layer);
      const range = settings && manifest ? rangeOf(manifest.guidance, layer) : null;
      return { range, value, note: mixed ? 'mixed' : null };
    },
    set: (value, beforeDrag) => guidanceSet(layer, value, beforeDrag),
    reset: () => guidanceReset(layer),
  };
}

/** A large fader for each layer, and beside each other small ones for music and variety. */
export function createFaders(store: Store): {
  readonly elements: readonly HTMLElement[];
  readonly show: (state: AppState) => void;
} {
  /** The control that was moved last, until the job that it caused has ended. */
  let changed: Control | null = null;
  let hadJob = false;
  const faders = FADERS.map((moved) => {
    const { control, set, reset } = moved;
    let beforeDrag: Guidance | undefined;
    const fader = createFader(control, moved, {
      change: (value) => {
        changed = control;
        apply(store, set(value, beforeDrag));
      },
      reset: (clicked) => {
        changed = control;
        if (clicked) apply(store, clickContinued());
        apply(store, reset());
      },
      grab: () => {
        beforeDrag = store.getState().settings?.guidance;
      },
      release: () => {
        beforeDrag = undefined;
      },
    });
    return { ...moved, fader };
  });
  const [coarse, fine, music, variety] = faders.map(({ fader }) => fader.root);
  return {
    elements: [coarse!, fine!, el('div', { class: 'fader-pair' }, music!, variety!)],
    show: (state) => {
      const job = state.job !== null;
      // The job begins a moment after the fader was moved, so only its end counts.
      if (hadJob && !job) changed = null;
      hadJob = job;
      for (const { control, shown, fader } of faders) {
        const { range, value, note } = shown(state);
        fader.show(range, value, note);
        fader.setApplying(job && changed === control);
      }
    },
  };
}
