import { includesOffsets, readPoses } from './poses';
import { parseBvhText } from './text';
import { pickDancer } from '../../retarget/dancers';
import { frameRate } from '../../retarget/frame-rate';
import { type MotionSource, restOf } from '../../retarget/source';

/**
 * Reads a BVH file: y or z up, any unit and order of channels, positions on every joint, one or several roots.
 *
 * @param part number of the dancer in a file with several
 * @throws {AppError} as `parseBvhText`
 */
export function readBvh(text: string, part = 0): MotionSource {
  const file = parseBvhText(text);
  const { nodes, frameLines, frameTime, warnings, truncated } = file;
  const included = includesOffsets(file);
  const source: MotionSource = {
    format: 'BVH',
    joints: nodes,
    rest: restOf(Float32Array.from(nodes.flatMap(({ offset }) => offset))),
    frames: frameLines.length,
    frameRate: () => frameRate(frameTime),
    rateAssumed: false,
    unit: null,
    upAxis: null,
    parts: [],
    part: 0,
    warnings,
    truncated,
    localPoses: (frames) => readPoses(file, frames, included),
  };
  return pickDancer(source, part);
}
