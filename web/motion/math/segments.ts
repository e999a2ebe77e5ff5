/**
 * Smallest distance between two segments, each given by its two ends as six numbers from an offset; points are
 * allowed. `segment_distance` of training/evaluation/metrics/penetration.py: clamped closest points after Ericson, Real-Time
 * Collision Detection, 5.1.9. Written out, since a long dance asks for it some hundred thousand times.
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
  const across = pp * qq - pq * pq;
  let s = across > TINY ? clamp((pq * qg - pg * qq) / across) : 0;
  const t = clamp((pq * s + qg) / Math.max(qq, TINY));
  s = pp > TINY ? clamp((pq * t - pg) / pp) : 0;
  return Math.sqrt((gx + s * px - t * qx) ** 2 + (gy + s * py - t * qy) ** 2 + (gz + s * pz - t * qz) ** 2);
}

const TINY = 1e-12;

function clamp(part: number): number {
  return Math.min(1, Math.max(0, part));
}
