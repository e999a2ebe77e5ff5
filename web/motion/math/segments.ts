/**
 * Smallest distance between two segments, each given by its two ends as six numbers from an offset; they may be
 * points. `segment_distance` of training/evaluation/metrics/penetration.py: clamped closest points after Ericson, Real-Time
 * Collision Detection, 5.1.9. Without vector objects, since a long dance takes some hundred thousand calls.
 * @param x with `z`: level shift of the second segment, metres
 */
export function segmentDistance(
  a: Float64Array,
  i: number,
  b: Float64Array,
  j: number,
  x = 0,
  z = 0,
): number {
  const px = a[i + 3]! - a[i]!;
  const py = a[i + 4]! - a[i + 1]!;
  const pz = a[i + 5]! - a[i + 2]!;
  const qx = b[j + 3]! - b[j]!;
  const qy = b[j + 4]! - b[j + 1]!;
  const qz = b[j + 5]! - b[j + 2]!;
  const gx = a[i]! - b[j]! - x;
  const gy = a[i + 1]! - b[j + 1]!;
  const gz = a[i + 2]! - b[j + 2]! - z;
  const pp = px * px + py * py + pz * pz;
  const qq = qx * qx + qy * qy + qz * qz;
  const pq = px * qx + py * qy + pz * qz;
  const pg = px * gx + py * gy + pz * gz;
  const qg = qx * gx + qy * gy + qz * gz;
  const determinant = pp * qq - pq * pq;
  let s = determinant > EPSILON ? clamp((pq * qg - pg * qq) / determinant) : 0;
  const t = clamp((pq * s + qg) / Math.max(qq, EPSILON));
  s = pp > EPSILON ? clamp((pq * t - pg) / pp) : 0;
  const dx = gx + s * px - t * qx;
  const dy = gy + s * py - t * qy;
  const dz = gz + s * pz - t * qz;
  return Math.sqrt(dx * dx + dy * dy + dz * dz);
}

const EPSILON = 1e-12;

function clamp(share: number): number {
  return Math.min(1, Math.max(0, share));
}
