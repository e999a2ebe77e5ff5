import type { AudioRecipe } from '../recipe';
import { type Accents, accentsOf, strongest } from './accents';
import { beatFrames } from './beat-times';
import { harmonyChanges } from './harmony';
import { metreOf, type Metre, phaseMeans } from './metre';
import { tempoCurve } from './tempo-curve';

/** Tempo, beats and metre of a song as the page shows them. */
export interface Rhythm extends Metre {
  /** Seconds of the song, ascending; empty without a steady beat. All numbers here are those of these beats. */
  readonly beats: readonly number[];
  /** Beats a minute over all beats; 0 without a steady beat. */
  readonly tempo: number;
  /** The slowest and the fastest eight beats, of which the outermost twentieths are left out, beats a minute. */
  readonly slowest: number;
  readonly fastest: number;
  /** Whether onsets repeat clearly; else the beats may not be those that one hears. */
  readonly sure: boolean;
}

/** Clarity from which there is a beat: noise, rain and speech reach 0.12, whales 0.17. */
const MIN_CLARITY = 0.19;
/** Clarity from which the beat is sure: songs with a steady beat have 0.31 and more, strings in free time 0.21. */
const SURE_CLARITY = 0.25;
/** Evidence that a change of harmony, 0 to 1, gives beside the logarithm of the bass's ratio. */
const HARMONY_EVIDENCE = 30;
/** Evidence from which the moments halfway between the beats are the beats. */
const MIN_EVIDENCE = 0.25;
/** With fewer beats than this nothing is counted. */
const MIN_BEATS = 8;
/** Intervals of a local tempo. */
const LOCAL = 8;
/** Frames by which the onset strength rises after a sharp onset is heard, measured on clicks. */
const LATENESS = 1.1;

/**
 * The rhythm of a song. It is made from the features that the model reads but changes none of them: the model goes on
 * hearing the beats of its training, which lie a whole number of frames apart.
 *
 * @param features frames x recipe.features
 */
export function rhythmOf(features: Float32Array, recipe: AudioRecipe): Rhythm {
  const accents = accentsOf(features, recipe);
  const { onset, framesPerSecond } = accents;
  const { periods, clarity } = tempoCurve(onset, framesPerSecond);
  const frames = clarity < MIN_CLARITY ? [] : onTheBeat(beatFrames(onset, periods), accents);
  if (frames.length < MIN_BEATS) return NO_RHYTHM;
  const beats = frames.map((frame) => Math.max(0, (frame - LATENESS) / framesPerSecond));
  const sure = clarity >= SURE_CLARITY;
  return { beats, ...tempoOf(beats), sure, ...metreOf(frames, accents) };
}

/**
 * The beats, or the moments halfway between them where bass and chords say so. The open hi-hat of house music is as
 * loud as the beat and sharper, but the bass is on the beat; the bass of a salsa is between the beats, but its chords
 * change on them.
 */
function onTheBeat(beats: readonly number[], accents: Accents): readonly number[] {
  const halves = beats.slice(1).map((beat, index) => (beat + beats[index]!) / 2);
  const { beatsPerBar } = metreOf(beats, accents);
  const bass = (frames: readonly number[]): number =>
    frames.reduce((sum, frame) => sum + strongest(accents.bass, frame), 1e-6) / Math.max(1, frames.length);
  const harmony = (frames: readonly number[]): number =>
    Math.max(...phaseMeans(harmonyChanges(frames, accents, beatsPerBar), beatsPerBar));
  const evidence =
    Math.log(bass(halves) / bass(beats)) + HARMONY_EVIDENCE * (harmony(halves) - harmony(beats));
  return evidence > MIN_EVIDENCE ? halves : beats;
}

/** No steady beat. */
export const NO_RHYTHM: Rhythm = {
  beats: [],
  tempo: 0,
  slowest: 0,
  fastest: 0,
  sure: false,
  beatsPerBar: 4,
  first: 0,
};

function tempoOf(beats: readonly number[]): Pick<Rhythm, 'tempo' | 'slowest' | 'fastest'> {
  const between = (from: number, to: number): number => (60 * (to - from)) / (beats[to]! - beats[from]!);
  const tempo = between(0, beats.length - 1);
  const local = beats
    .slice(LOCAL)
    .map((_, index) => between(index, index + LOCAL))
    .sort((a, b) => a - b);
  const part = (share: number): number => local[Math.round(share * (local.length - 1))] ?? tempo;
  return { tempo, slowest: part(0.05), fastest: part(0.95) };
}
