interface Mesh {
  readonly positions: Float32Array;
  readonly indices: Uint32Array;
}

/** Topology and volume of a mesh. */
export interface Topology {
  /** Edges with more triangles on one side than on the other: holes. */
  readonly holes: number;
  /** Edges that are not shared by exactly two triangles which run along it in opposite directions. */
  readonly openEdges: number;
  /** Vertices - edges + triangles: 2 for one closed surface without handles. */
  readonly euler: number;
  /** Enclosed volume in cubic metres; negative when the triangles face inwards. */
  readonly volume: number;
}

export function topology({ positions, indices }: Mesh): Topology {
  const directed = new Map<string, number>();
  let volume = 0;
  for (let t = 0; t < indices.length; t += 3) {
    const [a, b, c] = [indices[t]!, indices[t + 1]!, indices[t + 2]!];
    for (const [from, to] of [
      [a, b],
      [b, c],
      [c, a],
    ])
      directed.set(`${from} ${to}`, (directed.get(`${from} ${to}`) ?? 0) + 1);
    const p = (vertex: number, axis: number): number => positions[vertex * 3 + axis]!;
    volume +=
      (p(a, 0) * (p(b, 1) * p(c, 2) - p(b, 2) * p(c, 1)) +
        p(a, 1) * (p(b, 2) * p(c, 0) - p(b, 0) * p(c, 2)) +
        p(a, 2) * (p(b, 0) * p(c, 1) - p(b, 1) * p(c, 0))) /
      6;
  }
  let holes = 0;
  let openEdges = 0;
  for (const [edge, count] of directed) {
    const back = edge.split(' ').reverse().join(' ');
    if (count !== directed.get(back)) holes++;
    if (count !== 1 || directed.get(back) !== 1) openEdges++;
  }
  return { holes, openEdges, euler: positions.length / 3 - directed.size / 2 + indices.length / 3, volume };
}
