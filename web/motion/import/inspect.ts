import { type FileBytes, readMotion } from './read';
import { findAnyJoints } from '../retarget/joint-map';
import type { ImportOptions, RememberedJoints } from '../retarget/options';
import { skeletonFingerprint } from '../retarget/options';
import { worldPose } from '../retarget/sample';
import type { SourceJoint } from '../retarget/source';
import { type AxisName, findUp } from '../retarget/axes-and-units';
import type { JointName } from '../skeleton/skeleton';
import { sub, type Vec3 } from '../math/vec3';

/** What is in a motion file, whether or not a dancer can be made of it. */
export interface Inspection {
  readonly format: string;
  readonly parts: readonly string[];
  readonly part: number;
  /** Identifies the skeleton, see `skeletonFingerprint`. */
  readonly skeleton: string;
  readonly joints: readonly SourceJoint[];
  /** What seems to be up in the first frame, from hips to head; y where neither was found. */
  readonly upAxis: AxisName;
  /** joints x 3, the first frame in the file's own unit and axes. */
  readonly places: Float32Array;
  /** Index of the joint that stands for each of the 22, as far as they were found. */
  readonly found: Readonly<Partial<Record<JointName, number>>>;
}

/**
 * Reads the joints of a motion file and which of the 22 they are taken for.
 * @throws {AppError} what is wrong with the file itself
 */
export async function inspectMotion(
  files: readonly FileBytes[],
  options: ImportOptions = {},
  remembered: RememberedJoints = {},
): Promise<Inspection> {
  const source = await readMotion(files, options);
  const { format, parts, part, joints } = source;
  const skeleton = skeletonFingerprint(joints.map(({ name }) => name));
  const rest = worldPose(joints, source.rest, 0).places;
  const { nodes } = findAnyJoints(joints, rest, options.joints ?? remembered[skeleton]);
  const first = worldPose(joints, source.localPoses([0]), 0).places;
  const plain = joints.map(({ name, parent, endSite }) => ({ name, parent, endSite }));
  const places = Float32Array.from(first.flat());
  const found = Object.fromEntries(nodes);
  return { format, parts, part, skeleton, joints: plain, upAxis: upOf(nodes, first), places, found };
}

/** The axis from the hips to the head or neck; y where they were not found. */
function upOf(found: ReadonlyMap<JointName, number>, places: readonly Vec3[]): AxisName {
  const at = (...names: JointName[]): Vec3 | undefined =>
    names.map((name) => places[found.get(name) ?? -1]).find((place) => place !== undefined);
  const [top, bottom] = [at('head', 'neck'), at('left_hip', 'right_hip')];
  return top && bottom ? findUp(sub(top, bottom)).name : 'y';
}
