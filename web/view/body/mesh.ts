import { readVec, scale, smoothstep, type Vec3, writeVec } from '../../motion/math/vec3';
import { J } from '../../motion/skeleton/skeleton';
import { anatomy } from './anatomy';
import { bindPose } from './bind-pose';
import { smoothUnion } from './field';
import { shapesNear, type Build, type Shape } from './part';
import { skinTo, type Skin } from './skin';
import { neighbourMeans, surfaceNets, triangulate, type Grid, type Net } from './surface-nets';

/** A body in the bind pose, ready to be skinned. */
export interface BodyMesh extends Skin {
  /** vertices x 3, metres, pelvis at the origin. */
  readonly positions: Float32Array;
  /** vertices x 3, unit length, from the field. */
  readonly normals: Float32Array;
  /** triangles x 3. */
  readonly indices: Uint32Array;
  /** Per vertex: 1 on the body, less on the shoes (a factor on the linear colour). */
  readonly shade: Float32Array;
}

/** Spacing of the meshing grid, metres. */
export const CELL = 0.018;
/** Nodes a side of the blocks in which the grid is filled: blocks away from the body are skipped. */
const BLOCK = 4;
const SHOE_SHADE = 0.3;

/** Distance to the smooth union of `shapes`, in order. */
function distance(shapes: readonly Shape[], x: number, y: number, z: number): number {
  let d = 1;
  for (const shape of shapes) {
    const next = shape.field(x, y, z);
    const k = shape.blend(x, y, z);
    d = k > 0 ? smoothUnion(d, next, k) : Math.min(d, next);
  }
  return d;
}

/** Meshes a body for a skeleton: field, surface, normals, skin. Pure and deterministic. */
export function buildBody(offsets: ArrayLike<number>, build: Build): BodyMesh {
  const pose = bindPose(offsets);
  const { shapes, parts } = anatomy(pose, build);
  const net = surfaceNets(sample(shapes));
  const normals = relax(net, shapes);
  const skin = skinTo(net, parts, CELL);
  const shade = new Float32Array(net.positions.length / 3);
  const ankle = (pose.joints[J.left_ankle]![1] + pose.joints[J.right_ankle]![1]) / 2;
  for (let v = 0; v < shade.length; v++)
    shade[v] = SHOE_SHADE + (1 - SHOE_SHADE) * smoothstep(-0.008, 0.022, net.positions[v * 3 + 1]! - ankle);
  return { positions: net.positions, indices: triangulate(net), normals, ...skin, shade };
}

/** Distances on the grid, exact near the surface and only right in sign elsewhere. */
function sample(shapes: readonly Shape[]): Grid {
  const { size, origin } = extentOf(shapes);
  const grid: Grid = {
    values: new Float32Array(size[0] * size[1] * size[2]).fill(1),
    size,
    origin,
    cell: CELL,
  };
  for (let z = 0; z < size[2]; z += BLOCK)
    for (let y = 0; y < size[1]; y += BLOCK)
      for (let x = 0; x < size[0]; x += BLOCK) fillBlock(grid, [x, y, z], shapes);
  return grid;
}

/** Size and origin of a grid that holds all shapes, with two cells to spare. */
function extentOf(shapes: readonly Shape[]): Pick<Grid, 'size' | 'origin'> {
  const balls = shapes.flatMap((shape) => shape.bounds);
  const low = [0, 1, 2].map((axis) => Math.min(...balls.map((b) => b.centre[axis]! - b.radius)) - 2 * CELL);
  const high = [0, 1, 2].map((axis) => Math.max(...balls.map((b) => b.centre[axis]! + b.radius)) + 2 * CELL);
  // Node planes mirror at x = 0, so that a symmetric skeleton gets a symmetric body.
  const half = Math.ceil(Math.max(high[0]!, -low[0]!) / CELL);
  return {
    size: [
      2 * half + 1,
      Math.ceil((high[1]! - low[1]!) / CELL) + 1,
      Math.ceil((high[2]! - low[2]!) / CELL) + 1,
    ],
    origin: [-half * CELL, low[1]!, low[2]!],
  };
}

/** Writes the distances at the nodes of a block, the first of which is given, unless the block is away from the body. */
function fillBlock({ values, size, origin }: Grid, [bx, by, bz]: Vec3, shapes: readonly Shape[]): void {
  const radius = (BLOCK * CELL * Math.sqrt(3)) / 2;
  const x = origin[0] + (bx + (BLOCK - 1) / 2) * CELL;
  const y = origin[1] + (by + (BLOCK - 1) / 2) * CELL;
  const z = origin[2] + (bz + (BLOCK - 1) / 2) * CELL;
  const local = shapesNear(shapes, x, y, z, radius);
  if (local.length === 0) return;
  // Distances to stretched solids are bounds; the factor keeps blocks that they might misjudge.
  if (distance(local, x, y, z) > 1.6 * radius) return;
  for (let k = bz; k < Math.min(bz + BLOCK, size[2]); k++)
    for (let j = by; j < Math.min(by + BLOCK, size[1]); j++)
      for (let i = bx; i < Math.min(bx + BLOCK, size[0]); i++)
        values[i + size[0] * (j + size[1] * k)] = distance(
          local,
          origin[0] + i * CELL,
          origin[1] + j * CELL,
          origin[2] + k * CELL,
        );
}

/** Rounds of Laplacian smoothing and projection of the vertices. */
const ROUNDS = 4;
/** Distances at which the field is sampled for its gradient: for the projection, and for soft normals, metres. */
const PROJECTION_STEP = 0.002;
const NORMAL_STEP = 0.005;

/**
 * Spreads the vertices evenly over the surface and projects them onto it (in place); returns the normals of the field
 * there. The smoothing keeps thin parts, such as hands, free of the steps of the grid.
 */
function relax(net: Net, shapes: readonly Shape[]): Float32Array {
  const { positions } = net;
  const close = Array.from({ length: positions.length / 3 }, (_, v) =>
    shapesNear(shapes, ...readVec(positions, v), 2 * CELL),
  );
  for (let round = 0; round < ROUNDS; round++) {
    smooth(net);
    project(positions, close);
  }
  return normalsAt(positions, close);
}

/** Moves each vertex half of the way to the mean of its neighbours (in place). */
function smooth({ positions, quads }: Net): void {
  const means = neighbourMeans(quads, positions, 3);
  for (let i = 0; i < positions.length; i++) positions[i]! += 0.5 * (means[i]! - positions[i]!);
}

/**
 * Moves each vertex along the gradient towards the surface, by half a cell at most (in place).
 *
 * @param close the shapes near each vertex
 */
function project(positions: Float32Array, close: readonly (readonly Shape[])[]): void {
  for (const [v, shapes] of close.entries()) {
    const { gradient, value } = fieldAt(shapes, readVec(positions, v), PROJECTION_STEP);
    const along = Math.max(-0.5 * CELL, Math.min(0.5 * CELL, value)) / steepness(gradient);
    for (let axis = 0; axis < 3; axis++) positions[v * 3 + axis]! -= gradient[axis]! * along;
  }
}

/** Normals of the field at the vertices, vertices x 3. */
function normalsAt(positions: Float32Array, close: readonly (readonly Shape[])[]): Float32Array {
  const normals = new Float32Array(positions.length);
  for (const [v, shapes] of close.entries()) {
    const { gradient } = fieldAt(shapes, readVec(positions, v), NORMAL_STEP);
    writeVec(normals, v, scale(gradient, 1 / Math.sqrt(steepness(gradient))));
  }
  return normals;
}

/** Squared length of a gradient, kept from 0. */
function steepness([x, y, z]: Vec3): number {
  return Math.max(x * x + y * y + z * z, 1e-6);
}

/** The field around a point, from the corners of a small tetrahedron `e` away: four samples instead of seven. */
function fieldAt(shapes: readonly Shape[], [x, y, z]: Vec3, e: number): { gradient: Vec3; value: number } {
  const a = distance(shapes, x + e, y - e, z - e);
  const b = distance(shapes, x - e, y - e, z + e);
  const c = distance(shapes, x - e, y + e, z - e);
  const d = distance(shapes, x + e, y + e, z + e);
  return {
    gradient: [(a - b - c + d) / (4 * e), (-a - b + c + d) / (4 * e), (-a + b - c + d) / (4 * e)],
    value: (a + b + c + d) / 4,
  };
}
