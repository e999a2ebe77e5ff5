/** What happens to the settings of a generation. */
import type { Manifest } from '../model/client';
import { otherRole } from './couple';
import {
  columnOf,
  defaultGuidance,
  guidanceAt,
  held,
  sameGuidance,
  withCell,
  withColumn,
} from './guidance-matrix';
import type { Guidance, Layer, Settings } from './state';
import type { Change } from './store';

/** Sets all of them, as a ready-made reaction was made with. */
export function settingsSet(settings: Settings): Change {
  return () => ({ settings });
}

/**
 * Moves one layer of all streams together, held to the manifest's range and step (see `withColumn`).
 * @param from where the streams stood when the fader was taken in hand; where they stand now when not given
 */
export function guidanceSet(layer: Layer, value: number, from?: Guidance): Change {
  return guided((guidance, { guidance: range }) => withColumn(from ?? guidance, layer, value, range));
}

/** Sets one layer of one stream. */
export function guidanceCellSet(stream: string, layer: string, value: number): Change {
  return guided((guidance, { guidance: range }) => withCell(guidance, stream, layer, value, range));
}

/** Sets the whole matrix and the music, as a preset has them. */
export function presetChosen({ guidance, music }: Pick<Settings, 'guidance' | 'music'>): Change {
  return heard(
    () => music,
    guided(() => guidance),
  );
}

/** Moves the guidance of the music, held to the manifest's range and step. */
export function musicSet(value: number): Change {
  return heard(({ guidance: { music, step } }) => held(value, { ...music, step }));
}

/** Back to the manifest's guidance of the music. */
export function musicReset(): Change {
  return heard(({ guidance }) => guidance.music.default);
}

/** Back to the manifest's guidance: one layer of all streams, or everything, the music too. */
export function guidanceReset(layer?: Layer): Change {
  if (!layer)
    return heard(
      ({ guidance }) => guidance.music.default,
      guided((_, manifest) => defaultGuidance(manifest)),
    );
  return guided((guidance, manifest) => {
    const own = defaultGuidance(manifest);
    return Object.keys(guidance).reduce(
      (all, stream) => withCell(all, stream, layer, columnOf(own, layer).value, manifest.guidance),
      guidance,
    );
  });
}

/** Back to the manifest's guidance for one layer of one stream. */
export function guidanceCellReset(stream: string, layer: string): Change {
  return guided((guidance, manifest) =>
    withCell(
      guidance,
      stream,
      layer,
      guidanceAt(defaultGuidance(manifest), stream, layer),
      manifest.guidance,
    ),
  );
}

/** A change of the guidance alone; settings stay the same object when it comes out as it was. */
function guided(next: (guidance: Guidance, manifest: Manifest) => Guidance): Change {
  return ({ settings, manifest }) => {
    if (!settings || !manifest) return {};
    const guidance = next(settings.guidance, manifest);
    return sameGuidance(guidance, settings.guidance) ? {} : { settings: { ...settings, guidance } };
  };
}

/** A change of the guidance of the music, together with one of the rest. */
function heard(next: (manifest: Manifest) => number, along: Change = () => ({})): Change {
  return (state) => {
    const changes = along(state);
    const { settings = state.settings } = changes;
    if (!settings || !state.manifest) return changes;
    const music = next(state.manifest);
    return music === settings.music ? changes : { ...changes, settings: { ...settings, music } };
  };
}

/**
 * The dancers change parts. What the model danced in its old part makes no sense in the new one and leaves; who is
 * taken home is the one who is made.
 */
export function rolesSwapped(): Change {
  return ({ settings, download }) => {
    if (!settings) return {};
    const role = otherRole(settings.role);
    const who = download.who === 'both' ? 'both' : role;
    return {
      settings: { ...settings, role },
      download: { ...download, who },
      reaction: null,
      preview: null,
      // A leader and a reactor are not compared.
      other: null,
      letter: 'A',
      compare: 'off',
    };
  };
}

export function stepsSet(steps: number): Change {
  return ({ settings, manifest }) => {
    if (!settings || !manifest || !Number.isFinite(steps)) return {};
    const { min, max } = manifest.diffusion.steps;
    return { settings: { ...settings, steps: Math.min(max, Math.max(min, Math.round(steps))) } };
  };
}

export function seedSet(seed: number): Change {
  return ({ settings }) => {
    if (!settings || !Number.isFinite(seed)) return {};
    return { settings: { ...settings, seed: Math.min(0xffffffff, Math.max(0, Math.round(seed))) } };
  };
}

/** Another seed, unless it is locked. */
export function seedRolled(seed: number): Change {
  return (state) => (state.seedLocked ? {} : seedSet(seed)(state));
}

export function seedLockSet(seedLocked: boolean): Change {
  return () => ({ seedLocked });
}
