import { FPS } from '../../motion/skeleton/clip';
import { HEIGHTS, type Manifest, SEEDS } from '../../model/client';
import { clampedTo, rangeOf } from '../store/guidance-matrix';
import type { Inputs, LoadedLeader, LoadedSong, Settings } from '../store/reaction';
import { sameSettings } from '../store/selectors';
import type { AppState } from '../store/state';
import { currentInputs } from '../store/take';
import { type StoredInputs, storedInputs } from './stored-project';

/** The longest song that is read, in frames: a shift beyond it leaves no song. */
const MAX_SHIFT = 15 * 60 * FPS;

interface RestoredInputs {
  readonly inputs: Inputs;
  /** Whether settings were beyond what the model takes, and are the nearest that it takes now. */
  readonly changed: boolean;
}

/**
 * Stored inputs in the form that inputs have now. One that is missing or of another type takes the page's value.
 * @param state the page's, with its settings
 */
export function restoredInputs(
  stored: StoredInputs,
  state: AppState,
  leader: LoadedLeader,
  song: LoadedSong | null,
): RestoredInputs {
  // In proportion where a height is missing, and held hands where nothing is said of them.
  const own = state.settings && { ...state.settings, height: null, holdHands: true };
  const present = currentInputs({ ...state, leader, song, settings: own });
  if (!present || !state.manifest) throw new Error('Inputs are restored once the settings are there.');
  const alike = conform(storedInputs(present), stored) as Omit<Inputs, 'leader' | 'song'>;
  const settings = fitted(alike.settings, state.manifest);
  const shift = Number.isInteger(alike.shift) && Math.abs(alike.shift) <= MAX_SHIFT ? alike.shift : 0;
  return {
    inputs: { ...alike, settings, shift, leader, song },
    changed: !sameSettings(settings, alike.settings) || shift !== alike.shift,
  };
}

/** The value where it is of the example's type, part by part; the example elsewhere. */
function conform(example: unknown, value: unknown): unknown {
  if (typeof example === 'number')
    return typeof value === 'number' && Number.isFinite(value) ? value : example;
  // A number that need not be there.
  if (example === null) return typeof value === 'number' && Number.isFinite(value) ? value : null;
  if (typeof example !== 'object') return typeof value === typeof example ? value : example;
  if (value === null || typeof value !== 'object') return example;
  const parts = Object.entries(example).map(([key, part]) => [
    key,
    conform(part, (value as StoredInputs)[key]),
  ]);
  return Array.isArray(example) ? parts.map(([, part]) => part) : Object.fromEntries(parts);
}

/** The nearest settings that the model takes. */
function fitted(settings: Settings, { guidance }: Manifest): Settings {
  return {
    guidance: Object.fromEntries(
      Object.entries(settings.guidance).map(([stream, row]) => [
        stream,
        Object.fromEntries(
          Object.entries(row).map(([layer, value]) => [layer, clampedTo(value, rangeOf(guidance, layer))]),
        ),
      ]),
    ),
    music: clampedTo(settings.music, guidance.music),
    variety: clampedTo(settings.variety, guidance.variety),
    seed: clampedTo(Math.round(settings.seed), SEEDS),
    role: settings.role === 'leader' ? 'leader' : 'reactor',
    height: settings.height === null ? null : clampedTo(settings.height, HEIGHTS),
    holdHands: settings.holdHands,
  };
}
