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
function markersOf(motion: MadeMotion, frame: number): Map<string, Vec3> {
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

/** Processors whose numbers a file may have. */
const PROCESSORS = { intel: 84, dec: 85, mips: 86 } as const;

const UNITS_PER_METRE = { mm: 1000, cm: 100, m: 1, in: 1 / 0.0254 } as const;

interface Options {
  readonly subject?: string;
  /** Another dancer in the same recording. */
  readonly beside?: { readonly subject: string; readonly motion: MadeMotion };
  /** Whole numbers in place of floats. */
  readonly integers?: boolean;
  /** Frames in which a marker is not seen. */
  readonly hidden?: (label: string, frame: number) => boolean;
  readonly processor?: keyof typeof PROCESSORS;
  readonly unit?: keyof typeof UNITS_PER_METRE;
  /** The unit as the file names it, where it is not called so. */
  readonly unitName?: string;
  /** The fourth word of a marker that is not seen; 0 is that of one that is seen. */
  readonly residual?: number;
  /** Values of force plates after the markers of every frame. */
  readonly analog?: number;
  /** Number of the first frame: a recording that was cut does not begin at 1. */
  readonly first?: number;
  /** Labels in the first of two lists; all of them where it is left out. */
  readonly listed?: number;
  /** Whether only the head states the frame rate. */
  readonly rateInHead?: boolean;
  /** The label of a marker in place of its own; null where the file lacks it. */
  readonly relabel?: (label: string) => string | null;
}

/** The markers of the motion as a C3D file with z up. */
export function writeC3d(motion: MadeMotion, options: Options = {}): Uint8Array<ArrayBuffer> {
  const { subject = '', beside, integers = false, hidden = () => false, processor = 'intel' } = options;
  const { unit = 'mm', analog = 0, first = 1, rateInHead = false, relabel = (label) => label } = options;
  const { unitName = unit, residual = -1 } = options;
  const little = processor !== 'mips';
  const dancers = [{ subject, motion }, ...(beside ? [beside] : [])];
  const frames = Array.from(
    { length: motion.frames },
    (_, frame) =>
      new Map(
        dancers.flatMap((dancer) =>
          [...markersOf(dancer.motion, frame)].flatMap(([own, place]) => {
            const label = relabel(own);
            return label === null ? [] : [[`${dancer.subject}${label}`, place] as const];
          }),
        ),
      ),
  );
  const labels = [...frames[0]!.keys()];
  const float = (view: DataView, at: number, value: number): void => {
    // A DEC float has an exponent larger by two and its two words exchanged.
    view.setFloat32(at, processor === 'dec' ? value * 4 : value, processor === 'intel');
    if (processor !== 'dec') return;
    for (const word of [at, at + 2]) view.setUint16(word, view.getUint16(word), true);
  };
  const parameters: number[] = [0, 0, 3, PROCESSORS[processor]];
  const text = (value: string): number[] => [...value].map((letter) => letter.charCodeAt(0));
  const parameter = (name: string, type: number, sizes: readonly number[], data: readonly number[]): void => {
    const body = [type & 255, sizes.length, ...sizes, ...data, 0];
    const step = 2 + body.length;
    const link = little ? [step & 255, step >> 8] : [step >> 8, step & 255];
    parameters.push(name.length, 1, ...text(name), ...link, ...body);
  };
  const width = 24;
  parameters.push(5, 255, ...text('POINT'), ...(little ? [3, 0] : [0, 3]), 0);
  const { listed = labels.length } = options;
  for (const [name, some] of [
    ['LABELS', labels.slice(0, listed)],
    ['LABELS2', labels.slice(listed)],
  ] as const)
    if (some.length > 0)
      parameter(
        name,
        -1,
        [width, some.length],
        some.flatMap((label) => text(label.padEnd(width))),
      );
  parameter('UNITS', -1, [8], text(unitName.padEnd(8)));
  const rate = new DataView(new ArrayBuffer(4));
  float(rate, 0, motion.fps);
  if (!rateInHead) parameter('RATE', 4, [], [...new Uint8Array(rate.buffer)]);
  parameters.push(0, 0);
  const blocks = Math.ceil(parameters.length / 512);
  parameters[2] = blocks;
  const size = integers ? 2 : 4;
  const start = (1 + blocks) * 512;
  const row = (labels.length * 4 + analog) * size;
  // Programs fill the last block and may leave more of them empty.
  const out = new Uint8Array((Math.ceil((start + frames.length * row) / 512) + 2) * 512);
  const view = new DataView(out.buffer);
  out.set([2, 0x50]);
  [labels.length, analog, first, first + motion.frames - 1, 0].forEach((word, i) =>
    view.setUint16(2 + 2 * i, word, little),
  );
  const perMetre = UNITS_PER_METRE[unit];
  const step = 0.00005 * perMetre;
  float(view, 12, integers ? step : -step);
  view.setUint16(16, 2 + blocks, little);
  float(view, 20, motion.fps);
  out.set(parameters, 512);
  frames.forEach((markers, frame) =>
    labels.forEach((label, marker) => {
      const at = start + frame * row + marker * 4 * size;
      const [x, y, z] = markers.get(label)!;
      const unseen = hidden(label, frame);
      const words = [
        ...(unseen ? [0, 0, 0] : [x, -z, y].map((value) => value * perMetre)),
        unseen ? residual : 0,
      ];
      words.forEach((value, i) => {
        if (integers) view.setInt16(at + 2 * i, i < 3 ? Math.round(value / step) : value, little);
        else float(view, at + 4 * i, value);
      });
    }),
  );
  return out;
}
