import { type Role, otherRole } from '../../common/role';
import { type FrameRate, motionExtension, type MotionFormat } from '../../export/client';
import { FPS } from '../../motion/skeleton/clip';
import { fileSlug, slug } from '../store/format';
import { columnOf } from '../store/guidance-matrix';
import type { Inputs } from '../store/reaction';
import type { Span } from '../store/time-scale';

/** What a file name is made from. */
export interface FileNameParts {
  readonly inputs: Inputs;
  readonly footLock: boolean;
  /** Name of the take or its number in words, if the reaction is one. */
  readonly take?: string | null;
  /** The part of the dance that is written, seconds; null or left out for all of it. */
  readonly part?: Span | null;
  /** Frames a second of a motion. */
  readonly rate?: FrameRate;
}

/**
 * `song_leader_take_s1204_c1.20-f0.60-m3.00_footlock_reactor.bvh`, after what the reaction was made from. The file of
 * the loaded dancer alone is named after the inputs only. Where body parts differ, `c` and `f` are their means; `m`, the
 * guidance of the music, is there only with a song, `v`, the variety, only where it changes the seed, a part of the dance
 * as `12.0-20.5s`, and the frame rate where it is not the page's.
 */
export function motionFileName(named: FileNameParts, who: Role | 'both', format: MotionFormat): string {
  const parts =
    who === otherRole(named.inputs.settings.role)
      ? inputParts(named.inputs)
      : [...inputParts(named.inputs), ...settingsParts(named)];
  const { rate = FPS } = named;
  const last = rate === FPS ? [who] : [who, `${rate}fps`];
  return `${[...parts, ...partParts(named), ...last].join('_')}${motionExtension(format, who === 'both' ? 2 : 1)}`;
}

/** `song_leader_take_s1204_c1.20-f0.60-m3.00_footlock_1080p.webm`. */
export function videoFileName(named: FileNameParts, size: string, container: string): string {
  const parts = [...inputParts(named.inputs), ...settingsParts(named), ...partParts(named)];
  return `${[...parts, size].join('_')}.${container}`;
}

/** `song_leader_take_s1204_c1.20-f0.60-m3.00_footlock_at12.4s_1080p.png`. */
export function pictureFileName(named: FileNameParts, size: string, seconds: number): string {
  return `${[...inputParts(named.inputs), ...settingsParts(named), `at${tenths(seconds)}s`, size].join('_')}.png`;
}

function partParts({ part }: FileNameParts): string[] {
  return part ? [`${tenths(part.from)}-${tenths(part.to)}s`] : [];
}

/** Seconds to the tenth that the clock shows. */
const tenths = (seconds: number): string => (Math.floor(seconds * 10 + 1e-6) / 10).toFixed(1);

function inputParts({ song, leader }: Inputs): string[] {
  return [song ? fileSlug(song.name, 'song') : 'no-song', fileSlug(leader.name, 'leader')];
}

function settingsParts({ inputs: { song, settings }, footLock, take }: FileNameParts): string[] {
  const [coarse, fine] = [columnOf(settings.guidance, 'coarse'), columnOf(settings.guidance, 'fine')];
  return [
    ...(take ? [slug(take, 'take')] : []),
    `s${settings.seed}`,
    [
      `c${coarse.value.toFixed(2)}`,
      `f${fine.value.toFixed(2)}`,
      ...(coarse.mixed || fine.mixed ? ['mixed'] : []),
      ...(song ? [`m${settings.music.toFixed(2)}`] : []),
      ...(settings.variety === 1 ? [] : [`v${settings.variety.toFixed(2)}`]),
    ].join('-'),
    ...(footLock ? ['footlock'] : []),
  ];
}
