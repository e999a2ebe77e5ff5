import { BVHLoader } from 'three/addons/loaders/BVHLoader.js';
import type { BvhNode } from './hierarchy';
import type { BvhFile } from './text';
import type { LocalPoses } from '../../retarget/source';
import { readVec, sub, type Vec3, writeVec } from '../../math/vec3';

/** Frames that the loader gets at once: it allocates an object per joint and frame, too many for a long file. */
const CHUNK = 256;

/** Most frames in which it is looked what position channels hold. */
const COMPARED_FRAMES = 200;

/** Whether three's loader gives a node values: not where it is a tip without channels. */
const hasValues = ({ endSite, channels }: BvhNode): boolean => !endSite || channels.length > 0;

const hasPosition = ({ channels }: BvhNode): boolean =>
  channels.some((channel) => channel.endsWith('position'));

/** The lines of a node and everything below it in the one form that three's loader reads, with unique names. */
function canonical(nodes: readonly BvhNode[], at: number): string[] {
  const { offset, channels } = nodes[at]!;
  const children = nodes.flatMap((node, index) => (node.parent === at ? canonical(nodes, index) : []));
  const isJoint = hasValues(nodes[at]!);
  return [
    isJoint ? `JOINT j${at}` : 'End Site',
    '{',
    `OFFSET ${offset.join(' ')}`,
    ...(isJoint ? [`CHANNELS ${channels.length} ${channels.join(' ')}`] : []),
    ...children,
    '}',
  ];
}

/** Squared length of a vector. */
const squared = (v: Vec3): number => v[0] * v[0] + v[1] * v[1] + v[2] * v[2];

/**
 * Whether the position channels of a file hold translations from the parent, instead of what is added to each OFFSET.
 *
 * Programs disagree. A joint hardly moves against its parent, so for each joint below a root the reading that stays
 * nearer to the offset over the whole file is likely; hips that walk away below a root are outvoted by the other joints.
 */
export function includesOffsets({ nodes, frameLines }: BvhFile): boolean {
  let columns = 0;
  const placed = nodes.flatMap((node) => {
    const first = columns;
    columns += node.channels.length;
    return node.parent >= 0 && hasPosition(node) ? [{ ...node, first }] : [];
  });
  if (placed.length === 0) return false;
  const step = Math.ceil(frameLines.length / COMPARED_FRAMES);
  const rows = frameLines
    .filter((_, frame) => frame % step === 0)
    .map((line) => line.split(/\s+/).map(Number));
  const votes = placed.map(({ offset, channels, first }) => {
    const columnOf = (axis: string): number => channels.indexOf(`${axis}position`);
    const [x, y, z] = [columnOf('X'), columnOf('Y'), columnOf('Z')];
    let [asAdded, asTranslation] = [0, 0];
    for (const row of rows) {
      const at = (column: number): number => (column < 0 ? 0 : row[first + column]!);
      const value: Vec3 = [at(x), at(y), at(z)];
      asAdded += squared(value);
      asTranslation += squared(sub(value, offset));
    }
    return Math.sign(asAdded - asTranslation);
  });
  return votes.reduce((sum, vote) => sum + vote, 0) > 0;
}

/**
 * Local transforms of the nodes in the frames `wanted`, computed by three's BVHLoader from text that has been checked.
 *
 * @param included of `includesOffsets`
 */
export function readPoses(file: BvhFile, wanted: readonly number[], included: boolean): LocalPoses {
  const { nodes, frameLines } = file;
  const rotations = new Float32Array(wanted.length * nodes.length * 4);
  const translations = new Float32Array(wanted.length * nodes.length * 3);
  // The loader reads one root: a joint without channels, on which all roots of the file hang.
  const roots = nodes.flatMap(({ parent }, node) => (parent < 0 ? canonical(nodes, node) : []));
  const head = ['HIERARCHY', 'ROOT all', '{', 'OFFSET 0 0 0', 'CHANNELS 0', ...roots, '}', 'MOTION'].join(
    '\n',
  );
  const moving = nodes.flatMap((one, node) => (hasValues(one) ? [node] : []));
  const loader = new BVHLoader();
  for (let first = 0; first < wanted.length; first += CHUNK) {
    const lines = wanted.slice(first, first + CHUNK).map((frame) => frameLines[frame]!);
    const text = `${head}\nFrames: ${lines.length}\nFrame Time: 1\n${lines.join('\n')}`;
    const { tracks } = loader.parse(text).clip;
    // Two tracks per joint after those of the common root, in the order of the file: position (offset included) and
    // quaternion.
    moving.forEach((node, index) => {
      const positions = tracks[2 * index + 2]!.values;
      const quaternions = tracks[2 * index + 3]!.values;
      for (let frame = 0; frame < lines.length; frame++) {
        const at = (first + frame) * nodes.length + node;
        translations.set(positions.subarray(3 * frame, 3 * frame + 3), 3 * at);
        rotations.set(quaternions.subarray(4 * frame, 4 * frame + 4), 4 * at);
      }
    });
  }
  nodes.forEach((node, index) => {
    // The place of a root is the channels' own.
    const isOwn = hasPosition(node) && (node.parent < 0 || included);
    for (let at = index; at < wanted.length * nodes.length; at += nodes.length) {
      if (isOwn) writeVec(translations, at, sub(readVec(translations, at), node.offset));
      if (hasValues(node)) continue;
      writeVec(translations, at, node.offset);
      rotations[4 * at + 3] = 1;
    }
  });
  return { rotations, translations };
}
