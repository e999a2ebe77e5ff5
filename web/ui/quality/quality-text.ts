import type { Reference } from '../store/state';
import type { Moment, MomentKind, Report, Rules } from '../../quality/client';
import type { CardContent } from '../widgets/info-card';
import { clockTime, percent } from '../store/format';

export type Part = keyof Report;

/** The number and the sentences of a lane on the whole dance. */
interface LaneText {
  /** The number beside the lane's name; a dash where there is nothing to measure. */
  readonly value: string;
  /** The same and what it means, in sentences. */
  readonly sentence: string;
}

export const PART_NAMES: Readonly<Record<Part, string>> = {
  feet: 'Feet',
  closeness: 'Closest',
  beats: 'Beats',
  seams: 'Seams',
};

const metres = (length: number): string => `${length.toFixed(2)} m`;
const centimetres = (length: number): string => `${(length * 100).toFixed(length < 0.095 ? 1 : 0)} cm`;
const speed = (value: number): string => `${value.toFixed(2)} m/s`;
export const score = (value: number): string => value.toFixed(2);
/** Stands where there is nothing to measure. */
export const NOTHING = '–';

/** ` (recorded dancers: 33 %)`, where that is known. */
function recorded(value: number | null | undefined, write: (value: number) => string): string {
  return value === null || value === undefined ? '' : ` (recorded dancers: ${write(value)})`;
}

/**
 * The texts of the lanes.
 * @param block length of the model's blocks, seconds
 * @param reference what recorded dances score, if known for this model
 */
export function laneTexts(
  { feet, closeness, beats, seams }: Report,
  block: number,
  reference: Reference | null,
): Readonly<Record<Part, LaneText>> {
  return {
    feet: feetText(feet.whole, reference),
    closeness: closenessText(closeness.whole, reference),
    beats: beatText(beats.whole, reference),
    seams: seamText(seams.whole, block),
  };
}

function feetText(
  { skateShare, slideSpeed, contactShare }: Report['feet']['whole'],
  reference: Reference | null,
): LaneText {
  if (Number.isNaN(skateShare))
    return { value: NOTHING, sentence: 'The feet never touch the floor for long.' };
  return {
    value: percent(skateShare),
    sentence:
      `Feet slide ${percent(skateShare)} of the time they touch the floor` +
      `${recorded(reference?.skateShare, percent)}. Less is steadier. ` +
      `They are on the floor for ${percent(contactShare)} of the dance${recorded(reference?.contactShare, percent)} ` +
      `and move at ${speed(slideSpeed)} there${recorded(reference?.slideSpeed, speed)}.`,
  };
}

function closenessText(
  { closest, overlapShare, deepest }: Report['closeness']['whole'],
  reference: Reference | null,
): LaneText {
  const overlap =
    overlapShare > 0
      ? `The bodies overlap by more than a touch for ${percent(overlapShare)} of the dance` +
        `${recorded(reference?.overlapShare, percent)}, ${centimetres(deepest)} at most.`
      : 'The bodies never overlap.';
  return {
    value: metres(closest),
    sentence: `At their closest the hips of the two are ${metres(closest)} apart. ${overlap}`,
  };
}

function beatText({ music, leader }: Report['beats']['whole'], reference: Reference | null): LaneText {
  const one = (name: string, { value, chance }: typeof music, known: number | null | undefined): string =>
    Number.isNaN(value)
      ? `No beats of the ${name} were found.`
      : `With the ${name}: ${score(value)}, by chance ${score(chance)}${recorded(known, score)}.`;
  const brief = ({ value }: typeof music): string => (Number.isNaN(value) ? NOTHING : score(value));
  return {
    value: `${brief(music)} ${brief(leader)}`,
    sentence:
      'How often the partner turns or stops exactly on a beat, from 0 (never) to 1 (always). ' +
      `${one('music', music, reference?.music)} ${one('leader', leader, reference?.leader)}`,
  };
}

function seamText({ seams, ratio }: Report['seams']['whole'], block: number): LaneText {
  if (seams === 0 || Number.isNaN(ratio))
    return { value: NOTHING, sentence: 'The dance is so short that it is made in one piece.' };
  return {
    value: score(ratio),
    sentence:
      `The dance is made in blocks of ${Number(block.toFixed(1))} s. Where they meet, movement changes ` +
      `${score(ratio)} times as abruptly as elsewhere; around 1 no seam can be seen.`,
  };
}

const KIND_NAMES: Readonly<Record<MomentKind, string>> = {
  slide: 'Foot slide',
  overlap: 'Bodies overlap',
  music: 'Off the music’s beat',
  leader: 'Off the leader’s beat',
  seam: 'Rough seam',
};

/** The label of a mark: `Foot slide, 0.71 m/s at 0:25.1`. */
export function momentLabel({ kind, value, frame }: Moment, fps: number): string {
  const at = clockTime(frame / fps);
  const name = KIND_NAMES[kind];
  switch (kind) {
    case 'slide':
      return `${name}, ${speed(value)} at ${at}`;
    case 'overlap':
      return `${name}, ${centimetres(value)} at ${at}`;
    case 'music':
    case 'leader':
      return `${name}, ${score(value)} around ${at}`;
    case 'seam':
      return `${name}, ${score(value)} times the rest at ${at}`;
  }
}

/** The info card of a mark, for readers who do not know the measure: what happens there, and how bad it is. */
export function momentCard(moment: Moment, fps: number, { beats }: Report, rules: Rules): CardContent {
  const { kind, value, frame } = moment;
  const text = (): string => {
    switch (kind) {
      case 'slide':
        return (
          `A foot that stands on the floor slides at ${speed(value)}. ` +
          `Up to ${speed(rules.contact.slide_speed)} counts as standing still.`
        );
      case 'overlap':
        return (
          `The two bodies overlap by ${centimetres(value)}. ` +
          `Up to ${centimetres(rules.penetration.deep)} counts as a touch.`
        );
      case 'music':
      case 'leader':
        return (
          `Around here the partner’s moves miss most beats of the ${kind}: ${score(value)} on a scale from ` +
          `0 (all missed) to 1 (all met). By chance it would be ${score(beats.whole[kind].chance)}.`
        );
      case 'seam':
        return (
          `Two blocks of the dance meet here, and movement changes ${score(value)} times as abruptly ` +
          'as elsewhere. Around 1 nobody sees the seam.'
        );
    }
  };
  return { title: KIND_NAMES[kind], aside: clockTime(frame / fps), text: text() };
}
