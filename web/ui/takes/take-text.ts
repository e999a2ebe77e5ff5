import { columnOf, guidanceText } from '../store/guidance-matrix';
import { centimetres } from '../store/format';
import { modelIdentity, sameModel, type Inputs, type Settings, type Take } from '../store/reaction';
import type { AppState } from '../store/state';

/** Length at which the name of a file is cut, characters. */
const MAX_NAME_LENGTH = 16;

/**
 * What a take was made from, in a line: files, model and settings that differ from those on the page and the model's
 * defaults, seed and guidance always: `as leader, song 1.70 s later, seed 1204, 2 coarse, 1.5 fine`.
 */
export function takeText({ reaction }: Take, { leader, song, manifest }: AppState): string {
  const { model, inputs } = reaction;
  const { settings } = inputs;
  return [
    ...(inputs.leader === leader ? [] : [`to ${brief(inputs.leader.name)}`]),
    ...(inputs.song === song ? [] : [inputs.song ? brief(inputs.song.name) : 'no song']),
    ...(model && manifest && !sameModel(model, modelIdentity(manifest)) ? [`by ${brief(model.name)}`] : []),
    ...(settings.role === 'leader' ? ['as leader'] : []),
    ...shiftText(inputs),
    `seed ${settings.seed}`,
    ...(['coarse', 'fine'] as const).map((layer) => {
      const { value, mixed } = columnOf(settings.guidance, layer);
      return `${mixed ? 'about ' : ''}${plain(value)} ${layer}`;
    }),
    ...(settings.music === manifest?.guidance.music.default ? [] : [`${plain(settings.music)} music`]),
    ...(settings.variety === manifest?.guidance.variety.default
      ? []
      : [`${plain(settings.variety)} variety`]),
    ...bodyText(settings),
  ].join(', ');
}

/** All that a take was made from: `As reactor to Demo leader, with Patio Clave, 1.20 coarse, ..., seed 1204`. */
export function fullTakeText({ reaction: { inputs } }: Take): string {
  const { leader, song, settings } = inputs;
  return [
    `As ${settings.role} to ${leader.name}`,
    song ? `with ${song.name}` : 'without a song',
    ...shiftText(inputs),
    guidanceText(settings),
    ...bodyText(settings),
    `seed ${settings.seed}`,
  ].join(', ');
}

function shiftText({ shift, leader }: Inputs): string[] {
  // A frame is 0.03 s.
  const seconds = (Math.abs(shift) / leader.file.clip.fps).toFixed(2);
  return shift === 0 ? [] : [`song ${seconds} s ${shift > 0 ? 'later' : 'earlier'}`];
}

/** `170 cm tall`, where it is not in proportion, and `free hands`, where they do not hold the other dancer's. */
function bodyText({ height, holdHands }: Settings): string[] {
  return [
    ...(height === null ? [] : [`${centimetres(height)} cm tall`]),
    ...(holdHands ? [] : ['free hands']),
  ];
}

/** `2`, `1.5`, `0.05`: no trailing zeros. */
const plain = (value: number): string => String(Math.round(value * 100) / 100);

/** A file's name without its extension, cut where it is long. */
function brief(name: string): string {
  const stem = name.replace(/\.[a-z0-9]{1,5}$/i, '');
  // Emoji and rare letters are two units of a string.
  const letters = [...stem];
  const beginning = letters.slice(0, MAX_NAME_LENGTH - 1).join('');
  return letters.length > MAX_NAME_LENGTH ? `${beginning.trimEnd()}…` : stem;
}
