import type { Vec3 } from '../../motion/math/vec3';

/** A closed surface of quads, before it is smoothed and cut into triangles. */
export interface Net {
  /** vertices x 3, metres. */
  readonly positions: Float32Array;
  /** quads x 4, counter-clockwise seen from outside; every edge occurs once in each direction. */
  readonly quads: Uint32Array;
}

/** Distances at the nodes of a regular grid. */
export interface Grid {
  readonly values: Float32Array;
  /** Nodes along x, y, z; x is fastest. */
  readonly size: readonly [number, number, number];
  /** Position of node (0, 0, 0), metres. */
  readonly origin: readonly [number, number, number];
  /** Distance between neighbouring nodes, metres. */
  readonly cell: number;
}

/** Corners of a cell are numbered by bits: 1 = +x, 2 = +y, 4 = +z. Edges join corners that differ in one bit. */
const EDGES: readonly (readonly [number, number])[] = [
  [0, 1],
  [2, 3],
  [4, 5],
  [6, 7],
  [0, 2],
  [1, 3],
  [4, 6],
  [5, 7],
  [0, 4],
  [1, 5],
  [2, 6],
  [3, 7],
];
/** Places of the corners in their cell, from 0 to 1. */
const CORNERS = Array.from(
  { length: 8 },
  (_, corner) => [corner & 1, (corner >> 1) & 1, corner >> 2] as const,
);
/** Corners of each face in order around it. */
const FACES: readonly (readonly [number, number, number, number])[] = [
  [0, 2, 6, 4],
  [1, 3, 7, 5],
  [0, 1, 5, 4],
  [2, 3, 7, 6],
  [0, 1, 3, 2],
  [4, 5, 7, 6],
];

/** Number of the edge between two corners. */
const EDGE_OF = Int8Array.from({ length: 64 }, (_, pair) =>
  EDGES.findIndex(([p, q]) => p + 8 * q === pair || q + 8 * p === pair),
);
const edgeOf = (a: number, b: number): number => EDGE_OF[a + 8 * b]!;

/** Which corners of a cell are inside the surface is told by the bits of a number, one for each corner. */
const ALL_INSIDE = 255;
const isInside = (inside: number, corner: number): boolean => ((inside >> corner) & 1) === 1;

/**
 * Pairs of edges around a face that the same sheet of the surface crosses. Where it crosses all four, a sheet cuts off
 * each of the corners that are inside.
 */
function pairsOnFace(face: (typeof FACES)[number], inside: number): (readonly [number, number])[] {
  const edges = face.map((corner, i) => edgeOf(corner, face[(i + 1) % 4]!));
  const isIn = face.map((corner) => isInside(inside, corner));
  const crossed = edges.filter((_, i) => isIn[i] !== isIn[(i + 1) % 4]);
  if (crossed.length === 0) return [];
  if (crossed.length === 2) return [[crossed[0]!, crossed[1]!]];
  return [0, 1, 2, 3].filter((i) => isIn[i]).map((i) => [edges[(i + 3) % 4]!, edges[i]!]);
}

/** Which sheet of the surface crosses each edge of a cell, from 0; -1 where none does. */
function sheetsOf(inside: number): Int8Array {
  const group = EDGES.map(([a, b], edge) => (isInside(inside, a) === isInside(inside, b) ? -1 : edge));
  for (const [a, b] of FACES.flatMap((face) => pairsOnFace(face, inside))) {
    const [from, to] = [group[a]!, group[b]!];
    for (let edge = 0; edge < 12; edge++) if (group[edge] === from) group[edge] = to;
  }
  const names = [...new Set(group.filter((g) => g >= 0))];
  return Int8Array.from(group, (g) => names.indexOf(g));
}

/**
 * The sheet at each edge, for each of the 256 ways in which corners are inside. A cell crossed by two sheets gets two
 * vertices, so that sheets which only touch stay apart and the mesh is a manifold (dual marching cubes, Nielson 2004).
 */
const SHEETS = Array.from({ length: 256 }, (_, inside) => sheetsOf(inside));
/** The same the other way round: the edges that each sheet crosses. */
const SHEET_EDGES: readonly (readonly (readonly number[])[])[] = SHEETS.map((sheets) =>
  Array.from({ length: Math.max(...sheets) + 1 }, (_, sheet) =>
    [...sheets.keys()].filter((edge) => sheets[edge] === sheet),
  ),
);

/** The vertices of a net, and where to find those of a cell. Cells go by the node at their corner 0. */
interface Vertices {
  /** vertices x 3, metres. */
  readonly positions: Float32Array;
  /** The cells that the surface crosses, in the order of their nodes. */
  readonly cells: readonly number[];
  /** First vertex of each of these cells, by node; those of its sheets follow each other. */
  readonly first: Int32Array;
  /** Which corners of each of these cells are inside, by node. */
  readonly inside: Uint8Array;
}

/**
 * Meshes the zero level of a grid of distances with surface nets (Gibson 1998): one vertex per sheet and cell, one quad
 * per crossed grid edge. The surface must not touch the border of the grid. The result is always watertight; only where
 * one sheet passes twice through the same face of two cells do four triangles meet in an edge.
 */
export function surfaceNets(grid: Grid): Net {
  const vertices = verticesOf(grid);
  return { positions: vertices.positions, quads: quadsBetween(vertices, grid) };
}

/** Steps in the values of a grid to the next node along x, y and z. */
function stridesOf({ size: [nx, ny] }: Grid): Vec3 {
  return [1, nx, nx * ny];
}

/** Puts a vertex on each sheet of the surface in each cell. */
function verticesOf(grid: Grid): Vertices {
  const { values, size, origin, cell } = grid;
  const [nx, ny, nz] = size;
  const [sx, sy, sz] = stridesOf(grid);
  const corners = CORNERS.map(([x, y, z]) => x * sx + y * sy + z * sz);
  const positions: number[] = [];
  const cells: number[] = [];
  const first = new Int32Array(values.length);
  const inside = new Uint8Array(values.length);

  const addCell = (x: number, y: number, z: number): void => {
    const at = x * sx + y * sy + z * sz;
    const bits = cornersInside(values, at, corners);
    if (bits === 0 || bits === ALL_INSIDE) return;
    cells.push(at);
    first[at] = positions.length / 3;
    inside[at] = bits;
    for (const edges of SHEET_EDGES[bits]!) {
      const mean = meanCrossing(values, at, corners, edges);
      positions.push(
        origin[0] + (x + mean[0]) * cell,
        origin[1] + (y + mean[1]) * cell,
        origin[2] + (z + mean[2]) * cell,
      );
    }
  };
  for (let z = 0; z < nz - 1; z++)
    for (let y = 0; y < ny - 1; y++) for (let x = 0; x < nx - 1; x++) addCell(x, y, z);
  return { positions: Float32Array.from(positions), cells, first, inside };
}

/** @param corners steps from the cell's node to its corners, in the values of the grid */
function cornersInside(values: Float32Array, at: number, corners: readonly number[]): number {
  let inside = 0;
  for (let corner = 0; corner < 8; corner++) if (values[at + corners[corner]!]! < 0) inside |= 1 << corner;
  return inside;
}

/** Mean of the points where the surface crosses some edges of a cell, in cells from its corner 0. */
function meanCrossing(
  values: Float32Array,
  at: number,
  corners: readonly number[],
  edges: readonly number[],
): Vec3 {
  let x = 0;
  let y = 0;
  let z = 0;
  for (const edge of edges) {
    const [a, b] = EDGES[edge]!;
    const va = values[at + corners[a]!]!;
    const vb = values[at + corners[b]!]!;
    const t = va / (va - vb);
    const start = CORNERS[a]!;
    const end = CORNERS[b]!;
    x += start[0] + t * (end[0] - start[0]);
    y += start[1] + t * (end[1] - start[1]);
    z += start[2] + t * (end[2] - start[2]);
  }
  return [x / edges.length, y / edges.length, z / edges.length];
}

/** Joins the vertices of the four cells around each edge of the grid that the surface crosses; quads x 4. */
function quadsBetween({ cells, first, inside }: Vertices, grid: Grid): Uint32Array {
  const strides = stridesOf(grid);
  const quads: number[] = [];
  /** The vertex of a cell on the sheet that crosses its edge between two corners. */
  const vertex = (at: number, a: number, b: number): number =>
    first[at]! + SHEETS[inside[at]!]![edgeOf(a, b)]!;

  // Each edge belongs to the cell at whose node it starts.
  for (const at of cells) {
    const startsInside = grid.values[at]! < 0;
    for (let axis = 0; axis < 3; axis++) {
      const endsInside = grid.values[at + strides[axis]!]! < 0;
      if (startsInside === endsInside) continue;
      // The four cells around the edge, in order around the axis; `u` and `v` are the two other axes.
      const [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
      const [su, sv] = [strides[u]!, strides[v]!];
      const [bu, bv, bw] = [1 << u, 1 << v, 1 << axis];
      const p = vertex(at, 0, bw);
      const q = vertex(at - su, bu, bu | bw);
      const r = vertex(at - su - sv, bu | bv, bu | bv | bw);
      const s = vertex(at - sv, bv, bv | bw);
      if (startsInside) quads.push(p, q, r, s);
      else quads.push(p, s, r, q);
    }
  }
  return Uint32Array.from(quads);
}

/** Cuts quads along their shorter diagonals; triangles x 3, counter-clockwise seen from outside. */
export function triangulate({ positions, quads }: Net): Uint32Array {
  const indices = new Uint32Array((quads.length / 4) * 6);
  const span = (a: number, b: number): number => {
    const dx = positions[a * 3]! - positions[b * 3]!;
    const dy = positions[a * 3 + 1]! - positions[b * 3 + 1]!;
    const dz = positions[a * 3 + 2]! - positions[b * 3 + 2]!;
    return dx * dx + dy * dy + dz * dz;
  };
  for (let quad = 0; quad < quads.length; quad += 4) {
    const [a, b, c, d] = [quads[quad]!, quads[quad + 1]!, quads[quad + 2]!, quads[quad + 3]!];
    indices.set(span(a, c) <= span(b, d) ? [a, b, c, a, c, d] : [a, b, d, b, c, d], (quad / 4) * 6);
  }
  return indices;
}

/**
 * The mean of each vertex's neighbours.
 * @param values vertices x width
 * @returns vertices x width
 */
export function neighbourMeans(quads: Uint32Array, values: Float32Array, width: number): Float64Array {
  const sums = new Float32Array(values.length);
  const links = new Float32Array(values.length / width);
  // Every side is met once in each direction, so one direction here links both ends.
  for (let side = 0; side < quads.length; side++) {
    const from = quads[side]!;
    const to = quads[side % 4 === 3 ? side - 3 : side + 1]!;
    links[from]!++;
    for (let i = 0; i < width; i++) sums[from * width + i]! += values[to * width + i]!;
  }
  return new Float64Array(sums).map((sum, i) => sum / links[Math.floor(i / width)]!);
}
