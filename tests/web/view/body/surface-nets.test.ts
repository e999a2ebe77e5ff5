import { describe, expect, it } from 'vitest';
import { surfaceNets, triangulate, type Grid } from '../../../../web/view/body/surface-nets';
import { noise } from '../../support/skeletons';
import { topology } from '../../support/topology';

const meshed = (from: Grid): { positions: Float32Array; indices: Uint32Array } => {
  const net = surfaceNets(from);
  return { positions: net.positions, indices: triangulate(net) };
};

function grid(size: number, cell: number, field: (x: number, y: number, z: number) => number): Grid {
  const half = ((size - 1) * cell) / 2;
  const values = new Float32Array(size ** 3);
  for (let z = 0; z < size; z++)
    for (let y = 0; y < size; y++)
      for (let x = 0; x < size; x++)
        values[x + size * (y + size * z)] = field(x * cell - half, y * cell - half, z * cell - half);
  return { values, size: [size, size, size], origin: [-half, -half, -half], cell };
}

describe('surface nets', () => {
  it('meshes a ball as one closed surface of its volume, facing outwards', () => {
    const mesh = meshed(grid(24, 0.1, (x, y, z) => Math.hypot(x, y, z) - 0.8));
    const { openEdges, euler, volume } = topology(mesh);
    expect(openEdges).toBe(0);
    expect(euler).toBe(2);
    expect(volume / ((4 / 3) * Math.PI * 0.8 ** 3)).toBeGreaterThan(0.97);
    expect(volume / ((4 / 3) * Math.PI * 0.8 ** 3)).toBeLessThan(1.01);
  });

  it('keeps the hole of a torus', () => {
    const ring = grid(30, 0.1, (x, y, z) => Math.hypot(Math.hypot(x, z) - 0.8, y) - 0.3);
    expect(topology(meshed(ring))).toMatchObject({ openEdges: 0, euler: 0 });
  });

  it('keeps balls apart that meet at a corner or an edge of the grid', () => {
    for (const there of [
      [0.1, 0.1, 0],
      [0.1, 0.1, 0.1],
    ] as const) {
      const dots = grid(9, 0.1, (x, y, z) =>
        Math.min(Math.hypot(x, y, z), Math.hypot(x - there[0], y - there[1], z - there[2])) < 0.05 ? -1 : 1,
      );
      expect(topology(meshed(dots))).toMatchObject({ openEdges: 0, euler: 4 });
    }
  });

  it('closes every surface of a rough field', () => {
    const next = noise(7);
    const waves = Array.from({ length: 12 }, () => [next() * 9, next() * 9, next() * 9, next() * 3] as const);
    const rough = grid(32, 0.08, (x, y, z) => {
      const wave = waves.reduce((sum, [a, b, c, d]) => sum + Math.sin(a * x + b * y + c * z + d), 0);
      return Math.max(wave, Math.max(Math.abs(x), Math.abs(y), Math.abs(z)) * 20 - 22);
    });
    const mesh = meshed(rough);
    expect(mesh.indices.length).toBeGreaterThan(3000);
    const { holes, openEdges } = topology(mesh);
    expect(holes).toBe(0);
    expect(openEdges).toBeLessThan(mesh.indices.length / 3000);
  });
});
