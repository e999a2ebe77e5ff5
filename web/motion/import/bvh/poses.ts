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

/**
 * Whether a joint's position channels hold the translation from the parent, instead of what is added to its OFFSET.
 *
 * Programs disagree. A joint hardly moves against its parent, so the reading that stays nearer to the offset is taken.
 */
function includesOffset(offset: Vec3, values: readonly Vec3[]): boolean {
  const squared = (v: Vec3): number => v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
  const asTranslation = values.reduce((sum, value) => sum + squared(sub(value, offset)), 0);
  return asTranslation < values.reduce((sum, value) => sum + squared(value), 0);
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
  nodes.forEach((node, index) => {
    const all = wanted.map((_, frame) => frame * nodes.length + index);
    if (node.endSite) {
      for (const at of all) {
        writeVec(translations, at, node.offset);
        rotations[4 * at + 3] = 1;
      }
    } else if (node.channels.some((channel) => channel.endsWith('position'))) {
      const values = all.map((at) => sub(readVec(translations, at), node.offset));
      // The place of a root is the channels' own.
      if (node.parent < 0 || includesOffset(node.offset, values))
        all.forEach((at, frame) => writeVec(translations, at, values[frame]!));
    }
  });
  return { rotations, translations };
}
