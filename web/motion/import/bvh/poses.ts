import { BVHLoader } from 'three/addons/loaders/BVHLoader.js';
import type { BvhNode } from './hierarchy';
import type { BvhFile } from './text';
import type { LocalPoses } from '../../retarget/source';
import { readVec, sub, type Vec3, writeVec } from '../../math/vec3';

/** Frames that the loader gets at once: it allocates an object per joint and frame, too many for a long file. */
const CHUNK = 256;

/** The lines of a node and everything below it in the one form that three's loader reads, with unique names. */
function canonical(nodes: readonly BvhNode[], at: number): string[] {
  const { endSite, offset, channels } = nodes[at]!;
  const children = nodes.flatMap((node, index) => (node.parent === at ? canonical(nodes, index) : []));
  return [
    endSite ? 'End Site' : `JOINT j${at}`,
    '{',
    `OFFSET ${offset.join(' ')}`,
    ...(endSite ? [] : [`CHANNELS ${channels.length} ${channels.join(' ')}`]),
    ...children,
    '}',
  ];
}

/** Squared length of a vector. */
const squared = (v: Vec3): number => v[0] * v[0] + v[1] * v[1] + v[2] * v[2];

/**
 * Whether the position channels of a file hold translations from the parent, instead of what is added to each OFFSET.
 *
 * Programs disagree. A joint hardly moves against its parent, so for each joint the reading that stays nearer to the
 * offset is likely; hips that walk away below a root are outvoted by the other joints.
 *
 * @param joints offset and values over time of every joint below a root that has position channels
 */
function includeOffsets(
  joints: readonly { readonly offset: Vec3; readonly values: readonly Vec3[] }[],
): boolean {
  const votes = joints.map(({ offset, values }) => {
    const asTranslation = values.reduce((sum, value) => sum + squared(sub(value, offset)), 0);
    return Math.sign(values.reduce((sum, value) => sum + squared(value), 0) - asTranslation);
  });
  return votes.reduce((sum, vote) => sum + vote, 0) > 0;
}

/**
 * Local transforms of the nodes in the frames `wanted`, computed by three's BVHLoader from text that has been checked.
 */
export function readPoses(file: BvhFile, wanted: readonly number[]): LocalPoses {
  const { nodes, frameLines } = file;
  const rotations = new Float32Array(wanted.length * nodes.length * 4);
  const translations = new Float32Array(wanted.length * nodes.length * 3);
  // The loader reads one root: a joint without channels, on which all roots of the file hang.
  const roots = nodes.flatMap(({ parent }, node) => (parent < 0 ? canonical(nodes, node) : []));
  const head = ['HIERARCHY', 'ROOT all', '{', 'OFFSET 0 0 0', 'CHANNELS 0', ...roots, '}', 'MOTION'].join(
    '\n',
  );
  const moving = nodes.flatMap(({ endSite }, node) => (endSite ? [] : [node]));
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
  const placed = nodes.flatMap((node, index) => {
    const all = wanted.map((_, frame) => frame * nodes.length + index);
    if (node.endSite) {
      for (const at of all) {
        writeVec(translations, at, node.offset);
        rotations[4 * at + 3] = 1;
      }
    }
    if (!node.channels.some((channel) => channel.endsWith('position'))) return [];
    const values = all.map((at) => sub(readVec(translations, at), node.offset));
    return [{ ...node, all, values }];
  });
  const included = includeOffsets(placed.filter(({ parent }) => parent >= 0));
  for (const { parent, all, values } of placed) {
    // The place of a root is the channels' own.
    if (parent < 0 || included) all.forEach((at, frame) => writeVec(translations, at, values[frame]!));
  }
  return { rotations, translations };
}
