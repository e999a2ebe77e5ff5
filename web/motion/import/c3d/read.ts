import { type C3d, readC3dFile } from './file';
import { jointsOfMarkers, NEEDED, OPTIONAL } from './plug-in-gait';
import { closedGaps } from '../gaps';
import { sourceOfPositions } from '../positions';
import { AppError } from '../../../common/error';
import { checkedRate } from '../../retarget/frame-rate';
import type { MotionSource } from '../../retarget/source';
import type { JointName } from '../../skeleton/skeleton';
import { findUnit, type Unit } from '../../retarget/axes-and-units';
import { distance, lerp, readVec, type Vec3, writeVec, ZERO } from '../../math/vec3';

const UNITS: Readonly<Record<string, number>> = { mm: 0.001, cm: 0.01, m: 1, in: 0.0254 };

/** A dancer's name before the label of a marker: `Anna:LASI`. */
const SUBJECT = /^(.*?)[:_](?=[^:_]+$)/;
const markerOf = (label: string): string => label.replace(SUBJECT, '').toUpperCase();
const subjectOf = (label: string): string => SUBJECT.exec(label)?.[1] ?? '';

/** A marker's places over time without gaps; null where it was never seen. */
function filled({ places, frames, labels }: C3d, marker: number): Vec3[] | null {
  const given = Array.from({ length: frames }, (_, frame) => readVec(places, frame * labels.length + marker));
  return closedGaps(
    given,
    given.map((place) => place.every(Number.isFinite)),
  );
}

/** The needed markers that a subject lacks. */
function lacking(has: (label: string) => boolean): string[] {
  const missing = NEEDED.filter((label) => !has(label));
  if (!has('SACR') && !(has('LPSI') && has('RPSI'))) missing.push('LPSI, RPSI or SACR');
  for (const side of ['L', 'R'])
    if (!has(`${side}FIN`) && !(has(`${side}WRA`) && has(`${side}WRB`)))
      missing.push(`${side}WRA and ${side}WRB`);
  return missing;
}

/** The unit that the file states where the body has the size of a person in it, else the one in which it has. */
function unitOf(name: string, at: (label: string) => Vec3): Unit {
  const metres = UNITS[name.toLowerCase()];
  const hips = lerp(at('LASI'), at('RASI'), 0.5);
  const size = distance(hips, at('LKNE')) + distance(at('LKNE'), at('LANK')) + distance(hips, at('C7'));
  const { known, ...unit } = findUnit(
    size,
    metres === undefined ? null : { name: name.slice(0, 12), metres },
  );
  return known ? unit : { name: name.slice(0, 12), metres: metres ?? 0.001 };
}

/**
 * Reads a C3D file with markers of Plug-in Gait.
 *
 * @param part number of the dancer in a recording of several
 * @throws {AppError} `unreadable-file`, `missing-joints`, `too-long` or `too-few-frames`
 */
export function readC3d(bytes: Uint8Array, part: number): MotionSource {
  const file = readC3dFile(bytes);
  const subjects = [...new Set(file.labels.map(subjectOf))];
  const wanted = new Set([...NEEDED, ...OPTIONAL]);
  const tracksOf = (subject: string): Map<string, Vec3[]> =>
    new Map(
      file.labels
        .flatMap((label, marker) => {
          if (subjectOf(label) !== subject || !wanted.has(markerOf(label))) return [];
          const track = filled(file, marker);
          return track ? [[markerOf(label), track] as const] : [];
        })
        // The first of several markers of one label is kept.
        .reverse(),
    );
  const dancers = subjects
    .map((subject) => ({ subject, tracks: tracksOf(subject) }))
    .filter(({ tracks }) => lacking((label) => tracks.has(label)).length === 0);
  const chosen = dancers[part] ?? dancers[0];
  if (!chosen) throw missingMarkers(file, subjects.map(tracksOf));
  const { tracks } = chosen;
  const unit = unitOf(file.unit, (label) => tracks.get(label)![0]!);
  const { metres } = unit;
  const truncated = file.stated !== null && file.stated > file.frames;
  const frames = Array.from({ length: file.frames }, (_, frame) =>
    jointsOfMarkers(
      (label) => tracks.get(label)?.[frame] ?? ZERO,
      (label) => tracks.has(label),
      metres,
    ),
  );
  const names = [...(frames[0]?.keys() ?? [])];
  const places = new Float32Array(frames.length * names.length * 3);
  frames.forEach((joints, frame) =>
    names.forEach((name: JointName, joint) =>
      writeVec(places, frame * names.length + joint, joints.get(name)!),
    ),
  );
  const source = sourceOfPositions(
    { joints: names.map((name) => ({ name, parent: -1 })), places },
    {
      format: 'C3D',
      convention: 'Plug-in Gait',
      frameRate: () => checkedRate(file.rate),
      rateAssumed: false,
      unit,
      upAxis: 'z',
      parts: dancers.length > 1 ? dancers.map(({ subject }) => subject.slice(0, 80)) : [],
      part: dancers.indexOf(chosen),
    },
  );
  if (!truncated) return source;
  const warning = `The file ends after ${file.frames} of its ${file.stated} frames; these are used.`;
  return { ...source, warnings: [...source.warnings, warning], truncated };
}

function missingMarkers(file: C3d, subjects: readonly ReadonlyMap<string, unknown>[]): AppError {
  const missing = subjects
    .map((tracks) => lacking((label) => tracks.has(label)))
    .reduce((best, one) => (one.length < best.length ? one : best), [...NEEDED]);
  const seen = file.labels.slice(0, 8).map((label) => label.slice(0, 24));
  return new AppError(
    'missing-joints',
    `The C3D file lacks markers of Plug-in Gait: ${missing.slice(0, 6).join(', ')}${missing.length > 6 ? ' and others' : ''}.`,
    `Its markers are called ${seen.join(', ')}. Label them as Plug-in Gait, or export a solved skeleton as BVH or FBX.`,
  );
}
