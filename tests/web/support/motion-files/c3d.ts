import type { MadeMotion } from './made-motion';
import { rotate } from '../../../../web/motion/math/quat';
import {
  add,
  direction,
  dot,
  lerp,
  scale,
  sub,
  type Vec3,
  X_AXIS,
  Y_AXIS,
} from '../../../../web/motion/math/vec3';

/** Markers of Plug-in Gait on a plain made body, metres, y up: where a person would have glued them on. */
export function markersOf(motion: MadeMotion, frame: number): Map<string, Vec3> {
  const index = new Map(motion.joints.map(({ name }, joint) => [name, joint]));
  const at = (name: string): Vec3 => motion.places[frame]![index.get(`mixamorig:${name}`)!]!;
  const root = motion.rotations[frame]![0]!;
  const beside = (place: Vec3, x: number, y: number, z: number): Vec3 => add(place, rotate(root, [x, y, z]));
  const markers = new Map<string, Vec3>();
  for (const [l, side, sign] of [
    ['L', 'Left', 1],
    ['R', 'Right', -1],
  ] as const) {
    const outwards = (place: Vec3, from: Vec3, by: number): Vec3 => {
      const bone = direction(sub(place, from), Y_AXIS);
      const out = scale(rotate(root, X_AXIS), sign);
      return add(place, scale(direction(sub(out, scale(bone, dot(out, bone))), X_AXIS), by));
    };
    markers.set(`${l}ASI`, beside(at('Hips'), sign * 0.12, 0.043, 0.0555));
    markers.set(`${l}PSI`, beside(at('Hips'), sign * 0.05, 0.043, -0.135));
    markers.set(`${l}KNE`, outwards(at(`${side}Leg`), at(`${side}UpLeg`), 0.06));
    markers.set(`${l}ANK`, outwards(at(`${side}Foot`), at(`${side}Leg`), 0.045));
    markers.set(`${l}TOE`, at(`${side}ToeBase`));
    markers.set(`${l}SHO`, beside(at(`${side}Arm`), 0, 0.05, 0));
    markers.set(`${l}ELB`, at(`${side}ForeArm`));
    markers.set(`${l}WRA`, beside(at(`${side}Hand`), 0, 0, 0.03));
    markers.set(`${l}WRB`, beside(at(`${side}Hand`), 0, 0, -0.03));
    const head = lerp(at('Neck'), at('Head'), 1 / 0.6);
    markers.set(`${l}FHD`, beside(head, sign * 0.07, 0, 0.09));
    markers.set(`${l}BHD`, beside(head, sign * 0.07, 0, -0.09));
  }
  markers.set('C7', beside(at('Neck'), 0, 0, -0.04));
  markers.set('CLAV', beside(at('Neck'), 0, 0, 0.06));
  return markers;
}

interface Options {
  readonly subject?: string;
  /** Whole numbers in place of floats. */
  readonly integers?: boolean;
  /** Frames in which a marker is not seen. */
  readonly hidden?: (label: string, frame: number) => boolean;
}

/** The markers of the motion as a C3D file of an Intel processor: millimetres, z up. */
export function writeC3d(motion: MadeMotion, options: Options = {}): Uint8Array<ArrayBuffer> {
  const { subject = '', integers = false, hidden = () => false } = options;
  const frames = Array.from({ length: motion.frames }, (_, frame) => markersOf(motion, frame));
  const labels = [...frames[0]!.keys()];
  const parameters: number[] = [0, 0, 3, 84];
  const text = (value: string): number[] => [...value].map((letter) => letter.charCodeAt(0));
  const parameter = (name: string, type: number, sizes: readonly number[], data: readonly number[]): void => {
    const body = [type & 255, sizes.length, ...sizes, ...data, 0];
    const step = 2 + body.length;
    parameters.push(name.length, 1, ...text(name), step & 255, step >> 8, ...body);
  };
  const width = 24;
  parameters.push(5, 255, ...text('POINT'), 3, 0, 0);
  parameter(
    'LABELS',
    -1,
    [width, labels.length],
    labels.flatMap((label) => text(`${subject}${label}`.padEnd(width))),
  );
  parameter('UNITS', -1, [4], text('mm  '));
  parameter('RATE', 4, [], [...new Uint8Array(Float32Array.of(motion.fps).buffer)]);
  parameters.push(0, 0);
  const blocks = Math.ceil(parameters.length / 512);
  parameters[2] = blocks;
  const size = integers ? 2 : 4;
  const start = (1 + blocks) * 512;
  const out = new Uint8Array(start + frames.length * labels.length * 4 * size);
  const view = new DataView(out.buffer);
  out.set([2, 0x50]);
  [labels.length, 0, 1, motion.frames, 0].forEach((word, i) => view.setUint16(2 + 2 * i, word, true));
  const unit = integers ? 0.1 : -0.1;
  view.setFloat32(12, unit, true);
  view.setUint16(16, 2 + blocks, true);
  view.setFloat32(20, motion.fps, true);
  out.set(parameters, 512);
  frames.forEach((markers, frame) =>
    labels.forEach((label, marker) => {
      const at = start + (frame * labels.length + marker) * 4 * size;
      const [x, y, z] = markers.get(label)!;
      const unseen = hidden(label, frame);
      const words = [...(unseen ? [0, 0, 0] : [x * 1000, -z * 1000, y * 1000]), unseen ? -1 : 0];
      words.forEach((value, i) => {
        if (integers) view.setInt16(at + 2 * i, i < 3 ? Math.round(value / unit) : value, true);
        else view.setFloat32(at + 4 * i, value, true);
      });
    }),
  );
  return out;
}
