/** The settings of a generation. */
import { otherRole } from '../../../common/role';
import { HEIGHTS, type Manifest, SEEDS } from '../../../model/client';
import {
  columnOf,
  defaultGuidance,
  guidanceAt,
  clampedTo,
  clampedToStep,
  rangeOf,
  withCell,
  withColumn,
} from '../guidance-matrix';
import { sealed } from '../history/history';
import { sameSettings, upToDate } from '../selectors';
import type { Guidance, Layer, Settings, Weights } from '../reaction';
import type { Change } from '../store';

/** Sets all of them, to those of a ready-made reaction. */
export function settingsSet(settings: Settings): Change {
  return () => ({ settings });
}

/**
 * Moves one layer of all streams together, clamped to the manifest's range and step (see `withColumn`).
 * @param from the matrix when the drag of the fader began; the present one when not given
 */
export function guidanceSet(layer: Layer, value: number, from?: Guidance): Change {
  return guided(({ guidance }, { guidance: ranges }) => ({
    guidance: withColumn(guidance, layer, value, rangeOf(ranges, layer), from),
  }));
}

/** Sets one layer of one stream. */
export function guidanceCellSet(stream: string, layer: string, value: number): Change {
  return guided(({ guidance }, { guidance: ranges }) => ({
    guidance: withCell(guidance, stream, layer, value, rangeOf(ranges, layer)),
  }));
}

/** Sets the guidance weight of the music, clamped to the manifest's range and step. */
export function musicSet(value: number): Change {
  return guided((_, { guidance }) => ({ music: clampedToStep(value, guidance.music) }));
}

/** Sets how far the seed is from the mean of several seeds, clamped to the manifest's range and step. */
export function varietySet(value: number): Change {
  return guided((_, { guidance }) => ({ variety: clampedToStep(value, guidance.variety) }));
}

/** Sets the whole matrix, the music and the variety to those of a preset. */
export function presetChosen({ guidance, music, variety }: Weights): Change {
  return guided(() => ({ guidance, music, variety }));
}

/** Back to the manifest's guidance: one layer of all streams, or everything, music and variety too. */
export function guidanceReset(layer?: Layer): Change {
  return guided(({ guidance }, manifest) => {
    const own = defaultGuidance(manifest);
    const { music, variety } = manifest.guidance;
    if (!layer) return { guidance: own, music: music.default, variety: variety.default };
    const reset = (all: Guidance, stream: string): Guidance =>
      withCell(all, stream, layer, columnOf(own, layer).value, rangeOf(manifest.guidance, layer));
    return { guidance: Object.keys(guidance).reduce(reset, guidance) };
  });
}

/** Back to the manifest's guidance for one layer of one stream. */
export function guidanceCellReset(stream: string, layer: string): Change {
  return guided(({ guidance }, manifest) => {
    const value = guidanceAt(defaultGuidance(manifest), stream, layer);
    return { guidance: withCell(guidance, stream, layer, value, rangeOf(manifest.guidance, layer)) };
  });
}

/** Back to the manifest's guidance of the music. */
export function musicReset(): Change {
  return guided((_, { guidance }) => ({ music: guidance.music.default }));
}

/** Back to the manifest's variety. */
export function varietyReset(): Change {
  return guided((_, { guidance }) => ({ variety: guidance.variety.default }));
}

/** The pointer has grabbed a fader: until it is released, all changes and reactions are one step of undo and one take. */
export function dragBegun(): Change {
  return ({ history }) => ({ drag: { held: true, take: null }, history: sealed(history) });
}

/** A double click on a fader, whose first click has moved it: what follows is the same step of undo. */
export function clickContinued(): Change {
  return ({ history }) => ({ history: { ...history, open: true } });
}

/** The pointer has released the fader; the reaction to where it was released may still be on its way. */
export function dragEnded(): Change {
  return (state) => ({ drag: state.drag && !upToDate(state) ? { ...state.drag, held: false } : null });
}

/** A change of the guidance alone; settings stay the same object when it comes out as it was. */
function guided(next: (settings: Settings, manifest: Manifest) => Partial<Weights>): Change {
  return ({ settings, manifest }) => {
    if (!settings || !manifest) return {};
    const wanted = { ...settings, ...next(settings, manifest) };
    return sameSettings(wanted, settings) ? {} : { settings: wanted };
  };
}

/** Swaps the roles of the loaded and the generated dancer. The present reaction is removed from the stage. */
export function rolesSwapped(): Change {
  return ({ settings }) => {
    if (!settings) return {};
    return {
      settings: { ...settings, role: otherRole(settings.role) },
      reaction: null,
      preview: null,
      // A leader and a reactor are not compared.
      other: null,
      letter: 'A',
      compare: 'off',
    };
  };
}

/** Sets the height of the generated dancer, metres, clamped to what can be asked for; null is in proportion. */
export function heightSet(height: number | null): Change {
  return ({ settings }) => {
    if (!settings || Number.isNaN(height)) return {};
    const clamped = height === null ? null : clampedTo(height, HEIGHTS);
    return clamped === settings.height ? {} : { settings: { ...settings, height: clamped } };
  };
}

/** Sets whether the generated dancer's hands hold the loaded one's. */
export function holdHandsSet(holdHands: boolean): Change {
  return ({ settings }) => (settings ? { settings: { ...settings, holdHands } } : {});
}

export function seedSet(seed: number): Change {
  return ({ settings }) => {
    if (!settings || !Number.isFinite(seed)) return {};
    return { settings: { ...settings, seed: clampedTo(Math.round(seed), SEEDS) } };
  };
}

/** Sets another seed, unless the seed is locked. */
export function seedRandomized(seed: number): Change {
  return (state) => (state.seedLocked ? {} : seedSet(seed)(state));
}

export function seedLockSet(seedLocked: boolean): Change {
  return () => ({ seedLocked });
}

/** A random seed, small enough to read out and to type again. */
export function randomSeed(): number {
  return 1 + Math.floor(Math.random() * 9999);
}
