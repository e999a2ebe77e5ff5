import { mean } from '../../math/statistics';
import { distance, readVec } from '../../math/vec3';
import type { Positions } from '../positions';

/** Frames that are looked at, evenly spread. */
const SAMPLES = 60;
/** Least share of its mean by which the length of the middle bone changes where joints are doubted. */
const MAX_CHANGE = 0.5;

/** Whether most bones change their lengths so much that the values are hardly places of joints. */
export function changesLengths({ joints, places }: Positions): boolean {
  const frames = places.length / 3 / joints.length;
  const step = Math.max(1, Math.floor(frames / SAMPLES));
  const changes = joints.flatMap(({ parent }, joint) => {
    if (parent < 0) return [];
    const lengths: number[] = [];
    for (let frame = 0; frame < frames; frame += step) {
      const at = frame * joints.length;
      const length = distance(readVec(places, at + joint), readVec(places, at + parent));
      if (Number.isFinite(length)) lengths.push(length);
    }
    const typical = mean(lengths);
    return typical > 0 ? [(Math.max(...lengths) - Math.min(...lengths)) / typical] : [];
  });
  const middle = changes.sort((a, b) => a - b)[Math.floor(changes.length / 2)];
  return middle !== undefined && middle > MAX_CHANGE;
}
