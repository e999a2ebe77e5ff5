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
  const [px, py, pz] = [a[i + 3]! - a[i]!, a[i + 4]! - a[i + 1]!, a[i + 5]! - a[i + 2]!];
  const [qx, qy, qz] = [b[j + 3]! - b[j]!, b[j + 4]! - b[j + 1]!, b[j + 5]! - b[j + 2]!];
  const [gx, gy, gz] = [a[i]! - b[j]! - x, a[i + 1]! - b[j + 1]!, a[i + 2]! - b[j + 2]! - z];
  const pp = px * px + py * py + pz * pz;
  const qq = qx * qx + qy * qy + qz * qz;
  const pq = px * qx + py * qy + pz * qz;
  const pg = px * gx + py * gy + pz * gz;
  const qg = qx * gx + qy * gy + qz * gz;
  const determinant = pp * qq - pq * pq;
  let s = determinant > EPSILON ? clamp((pq * qg - pg * qq) / determinant) : 0;
  const t = clamp((pq * s + qg) / Math.max(qq, EPSILON));
  s = pp > EPSILON ? clamp((pq * t - pg) / pp) : 0;
  return Math.sqrt((gx + s * px - t * qx) ** 2 + (gy + s * py - t * qy) ** 2 + (gz + s * pz - t * qz) ** 2);
}

const EPSILON = 1e-12;

function clamp(share: number): number {
  return Math.min(1, Math.max(0, share));
}
