import { columnOf, guidanceWords } from '../store/guidance-matrix';
import type { AppState, Inputs, Take } from '../store/state';

/** Longest name of a file in a line, characters. */
const LONGEST = 16;

/**
 * What a take was made from, in a line: first what sets it apart from the files on the page and from the model's own
 * ways, then what nearly every take has of its own: `as leader, song 1.7 s later, 6 steps, seed 1204, 2 coarse, 1.5 fine`.
 */
export function takeWords({ reaction: { inputs } }: Take, { leader, song, manifest }: AppState): string {
  const { settings } = inputs;
  return [
    ...(inputs.leader === leader ? [] : [`to ${brief(inputs.leader.name)}`]),
    ...(inputs.song === song ? [] : [inputs.song ? brief(inputs.song.name) : 'no song']),
    ...(settings.role === 'leader' ? ['as leader'] : []),
    ...shiftWords(inputs),
    ...(settings.steps === manifest?.diffusion.steps.default ? [] : [stepWords(settings.steps)]),
    `seed ${settings.seed}`,
    ...(['coarse', 'fine'] as const).map((layer) => {
      const { value, mixed } = columnOf(settings.guidance, layer);
      return `${mixed ? 'about ' : ''}${plain(value)} ${layer}`;
    }),
    ...(settings.music === manifest?.guidance.music.default ? [] : [`${plain(settings.music)} music`]),
  ].join(', ');
}

/** All that a take was made from: `As reactor to Demo leader, with Patio Clave, 5 steps, 1.20 coarse, ..., seed 1204`. */
export function allTakeWords({ reaction: { inputs } }: Take): string {
  const { leader, song, settings } = inputs;
  return [
    `As ${settings.role} to ${leader.name}`,
    song ? `with ${song.name}` : 'without a song',
    ...shiftWords(inputs),
    stepWords(settings.steps),
    guidanceWords(settings),
    `seed ${settings.seed}`,
  ].join(', ');
}

function shiftWords({ shift, leader }: Inputs): string[] {
  const seconds = (Math.abs(shift) / leader.file.clip.fps).toFixed(1);
  return shift === 0 ? [] : [`song ${seconds} s ${shift > 0 ? 'later' : 'earlier'}`];
}

const stepWords = (steps: number): string => `${steps} ${steps === 1 ? 'step' : 'steps'}`;

/** `2`, `1.5`, `0.05`: no needless zeros. */
const plain = (value: number): string => String(Math.round(value * 100) / 100);

/** A file's name without its ending, cut where it is long. */
function brief(name: string): string {
  const stem = name.replace(/\.[a-z0-9]{1,5}$/i, '');
  return stem.length > LONGEST ? `${stem.slice(0, LONGEST - 1).trimEnd()}…` : stem;
}
