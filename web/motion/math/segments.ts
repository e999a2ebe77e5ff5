/** Two segments as vectors p and q along them, the vector g from the second's start to the first's, and products of p and q. */
export interface SegmentPair {
  readonly px: number;
  readonly py: number;
  readonly pz: number;
  readonly qx: number;
  readonly qy: number;
  readonly qz: number;
  readonly gx: number;
  readonly gy: number;
  readonly gz: number;
  readonly pp: number;
  readonly qq: number;
  readonly pq: number;
}

/** Two segments, each given by its two ends as six numbers from an offset; they may be points. */
export function segmentPair(a: Float64Array, i: number, b: Float64Array, j: number): SegmentPair {
  const [px, py, pz] = [a[i + 3]! - a[i]!, a[i + 4]! - a[i + 1]!, a[i + 5]! - a[i + 2]!];
  const [qx, qy, qz] = [b[j + 3]! - b[j]!, b[j + 4]! - b[j + 1]!, b[j + 5]! - b[j + 2]!];
  const [gx, gy, gz] = [a[i]! - b[j]!, a[i + 1]! - b[j + 1]!, a[i + 2]! - b[j + 2]!];
  const pp = px * px + py * py + pz * pz;
  const qq = qx * qx + qy * qy + qz * qz;
  const pq = px * qx + py * qy + pz * qz;
  return { px, py, pz, qx, qy, qz, gx, gy, gz, pp, qq, pq };
}

/**
 * Square of the smallest distance between two segments: `segment_distance` of
 * training/evaluation/metrics/penetration.py; clamped closest points after Ericson, Real-Time Collision Detection, 5.1.9.
 * @param x with `z`: level shift of the second segment, metres
 */
export function squaredDistance(pair: SegmentPair, x = 0, z = 0): number {
  const { px, py, pz, qx, qy, qz, gy, pp, qq, pq } = pair;
  const gx = pair.gx - x;
  const gz = pair.gz - z;
  const pg = px * gx + py * gy + pz * gz;
  const qg = qx * gx + qy * gy + qz * gz;
  const determinant = pp * qq - pq * pq;
  let s = determinant > EPSILON ? clamp((pq * qg - pg * qq) / determinant) : 0;
  const t = clamp((pq * s + qg) / Math.max(qq, EPSILON));
  s = pp > EPSILON ? clamp((pq * t - pg) / pp) : 0;
  const dx = gx + s * px - t * qx;
  const dy = gy + s * py - t * qy;
  const dz = gz + s * pz - t * qz;
  return dx * dx + dy * dy + dz * dz;
}

const EPSILON = 1e-12;

function clamp(share: number): number {
  return Math.min(1, Math.max(0, share));
}
