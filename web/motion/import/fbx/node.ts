import { AppError } from '../../../common/error';

/** One value of a node: arrays are numbers; whole numbers that a double does not hold, as ids can be, are text. */
export type FbxValue = number | string | Float64Array;

/** A node of the tree that both forms of FBX write. */
export interface FbxNode {
  readonly name: string;
  readonly values: FbxValue[];
  readonly children: FbxNode[];
}

/** Largest number of nodes: a long dance of a body with fingers has some 20,000. */
const MAX_NODES = 500_000;
/** Largest depth; files of all programs have less than ten levels. */
const MAX_DEPTH = 32;
/** Largest number of values of all arrays that are kept. */
const MAX_ARRAY_VALUES = 4e7;

/** Nodes of meshes, materials and pictures, whose content is not kept. */
const SKIPPED = new Set([
  'Geometry',
  'Texture',
  'Video',
  'Material',
  'Deformer',
  'Pose',
  'Thumbnail',
  'Takes',
  'Definitions',
]);

export const isSkipped = (name: string): boolean => SKIPPED.has(name);

/** The error of a file that is not as FBX says. */
export function damagedFbx(what: string, cause?: unknown): AppError {
  return new AppError(
    'unreadable-file',
    `The FBX file is damaged: ${what}.`,
    'Download, copy or export it again; as FBX 2013 or newer with its animation.',
    { cause },
  );
}

/** Counts what is read, so that a file with absurd counts is refused before it fills the memory. */
export class FbxBudget {
  private nodes = 0;
  private values = 0;

  /** @throws {AppError} `unreadable-file` */
  node(depth: number): void {
    if (++this.nodes > MAX_NODES) throw damagedFbx(`it has more than ${MAX_NODES} nodes`);
    if (depth > MAX_DEPTH) throw damagedFbx(`its nodes are nested more than ${MAX_DEPTH} deep`);
  }

  /** @throws {AppError} `unreadable-file` */
  array(count: number): void {
    this.values += count;
    if (!(this.values <= MAX_ARRAY_VALUES))
      throw damagedFbx(`its arrays hold more than ${MAX_ARRAY_VALUES / 1e6} million values`);
  }
}

export const childOf = (node: FbxNode | undefined, name: string): FbxNode | undefined =>
  node?.children.find((child) => child.name === name);

/** The first value of a child as an array of numbers; empty where it is none. */
export function arrayOf(node: FbxNode, name: string): Float64Array {
  const child = childOf(node, name);
  const value = child?.values[0];
  if (value instanceof Float64Array) return value;
  // The text form of version 7 has its arrays in a child "a".
  const inner = childOf(child, 'a')?.values ?? child?.values ?? [];
  return Float64Array.from(inner.filter((one) => typeof one === 'number'));
}
