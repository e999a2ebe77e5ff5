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

/**
 * For each of the 256 configurations of the corners: which sheet of the surface each edge belongs to (-1: not crossed).
 * A cell crossed by two sheets gets two vertices, so that sheets which only touch stay apart and the mesh is a
 * manifold (dual marching cubes, Nielson 2004).
 */
const SHEETS: readonly Int8Array[] = Array.from({ length: 256 }, (_, inside) => {
  const isIn = (corner: number): boolean => ((inside >> corner) & 1) === 1;
  const group = EDGES.map(([a, b], edge) => (isIn(a) === isIn(b) ? -1 : edge));
  const join = (a: number, b: number): void => {
    const [from, to] = [group[a]!, group[b]!];
    for (let edge = 0; edge < 12; edge++) if (group[edge] === from) group[edge] = to;
  };
  for (const face of FACES) {
    const crossed = face
      .map((corner, i) => edgeOf(corner, face[(i + 1) % 4]!))
      .filter((edge) => group[edge] !== -1);
    if (crossed.length === 2) join(crossed[0]!, crossed[1]!);
    if (crossed.length === 4)
      for (let i = 0; i < 4; i++)
        if (isIn(face[i]!)) join(edgeOf(face[(i + 3) % 4]!, face[i]!), edgeOf(face[i]!, face[(i + 1) % 4]!));
  }
  const names = [...new Set(group.filter((g) => g >= 0))];
  return Int8Array.from(group, (g) => (g < 0 ? -1 : names.indexOf(g)));
});

/**
 * Meshes the zero level of a grid of distances with surface nets (Gibson 1998): one vertex per sheet and cell, one quad
 * per crossed grid edge. The surface must not touch the border of the grid. The result is always watertight; only where
 * one sheet passes twice through the same face of two cells do four triangles meet in an edge.
 */
export function surfaceNets(grid: Grid): Net {
  const { values, size, origin, cell } = grid;
  const [nx, ny, nz] = size;
  const strides = [1, nx, nx * ny] as const;
  const corners = Array.from(
    { length: 8 },
    (_, c) => (c & 1) * strides[0] + ((c >> 1) & 1) * strides[1] + ((c >> 2) & 1) * strides[2],
  );
  const positions: number[] = [];
  /** First vertex and configuration of each crossed cell. */
  const first = new Int32Array(values.length).fill(-1);
  const config = new Uint8Array(values.length);
  const sum = new Float64Array(3 * 4);
  const count = new Uint8Array(4);

  for (let z = 0; z < nz - 1; z++)
    for (let y = 0; y < ny - 1; y++)
      for (let x = 0; x < nx - 1; x++) {
        const at = x + y * strides[1] + z * strides[2];
        let inside = 0;
        for (let c = 0; c < 8; c++) if (values[at + corners[c]!]! < 0) inside |= 1 << c;
        if (inside === 0 || inside === 255) continue;
        const sheets = SHEETS[inside]!;
        sum.fill(0);
        count.fill(0);
        for (let e = 0; e < 12; e++) {
          const sheet = sheets[e]!;
          if (sheet < 0) continue;
          const [a, b] = EDGES[e]!;
          const va = values[at + corners[a]!]!;
          const vb = values[at + corners[b]!]!;
          const t = va / (va - vb);
          for (let axis = 0; axis < 3; axis++) {
            const pa = (a >> axis) & 1;
            sum[sheet * 3 + axis]! += pa + t * (((b >> axis) & 1) - pa);
          }
          count[sheet]!++;
        }
        first[at] = positions.length / 3;
        config[at] = inside;
        for (let sheet = 0; sheet < 4 && count[sheet]! > 0; sheet++) {
          const n = count[sheet]!;
          positions.push(
            origin[0] + (x + sum[sheet * 3]! / n) * cell,
            origin[1] + (y + sum[sheet * 3 + 1]! / n) * cell,
            origin[2] + (z + sum[sheet * 3 + 2]! / n) * cell,
          );
        }
      }

  const vertex = (at: number, a: number, b: number): number =>
    first[at]! + SHEETS[config[at]!]![edgeOf(a, b)]!;
  const quads: number[] = [];
  for (let z = 1; z < nz - 1; z++)
    for (let y = 1; y < ny - 1; y++)
      for (let x = 1; x < nx - 1; x++) {
        const at = x + y * strides[1] + z * strides[2];
        const starts = values[at]! < 0;
        for (let axis = 0; axis < 3; axis++) {
          if (starts === values[at + strides[axis]!]! < 0) continue;
          // The four cells around the edge, in order around the axis; `u` and `v` are the two other axes.
          const [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
          const [su, sv] = [strides[u]!, strides[v]!];
          const [bu, bv, bw] = [1 << u, 1 << v, 1 << axis];
          const p = vertex(at, 0, bw);
          const q = vertex(at - su, bu, bu | bw);
          const r = vertex(at - su - sv, bu | bv, bu | bv | bw);
          const s = vertex(at - sv, bv, bv | bw);
          if (starts) quads.push(p, q, r, s);
          else quads.push(p, s, r, q);
        }
      }
  return { positions: Float32Array.from(positions), quads: Uint32Array.from(quads) };
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
