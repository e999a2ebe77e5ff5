/** Files that the browser tests drop on the page. All are made here; nothing is recorded from anyone. */

export interface TestFile {
  readonly name: string;
  readonly mimeType: string;
  readonly buffer: Buffer;
}

const file = (name: string, mimeType: string, content: string | Buffer): TestFile => ({
  name,
  mimeType,
  buffer: Buffer.from(content),
});

// ---- songs ----

/** What a made song sounds like: a beat with a bass, or nothing. */
export interface SongOptions {
  readonly seconds: number;
  readonly bpm?: number;
  readonly silent?: boolean;
  readonly rate?: number;
  readonly name?: string;
}

/** A WAV with a kick on each beat, a click on each off-beat and a bass that changes with the bar. */
export function wav({
  seconds,
  bpm = 120,
  silent = false,
  rate = 22050,
  name = 'made song.wav',
}: SongOptions): TestFile {
  const samples = Math.round(seconds * rate);
  const data = Buffer.alloc(44 + samples * 2);
  data.write('RIFF', 0);
  data.writeUInt32LE(36 + samples * 2, 4);
  data.write('WAVEfmt ', 8);
  data.writeUInt32LE(16, 16);
  data.writeUInt16LE(1, 20);
  data.writeUInt16LE(1, 22);
  data.writeUInt32LE(rate, 24);
  data.writeUInt32LE(rate * 2, 28);
  data.writeUInt16LE(2, 32);
  data.writeUInt16LE(16, 34);
  data.write('data', 36);
  data.writeUInt32LE(samples * 2, 40);
  if (!silent) {
    const beat = 60 / bpm;
    const bass = [98, 98, 130.8, 146.8];
    for (let i = 0; i < samples; i++) {
      const t = i / rate;
      const onBeat = t % beat;
      const offBeat = (t + beat / 2) % beat;
      const kick = Math.sin(2 * Math.PI * 55 * onBeat) * Math.exp(-onBeat * 18);
      const click = Math.sin(2 * Math.PI * 2100 * offBeat) * Math.exp(-offBeat * 90);
      const note = bass[Math.floor(t / (4 * beat)) % bass.length] ?? 98;
      const value = 0.6 * kick + 0.2 * click + 0.15 * Math.sin(2 * Math.PI * note * t);
      data.writeInt16LE(Math.round(Math.max(-1, Math.min(1, value)) * 32000), 44 + i * 2);
    }
  }
  return { name, mimeType: 'audio/wav', buffer: data };
}

export const notAudio = (): TestFile =>
  file('holiday.mp3', 'audio/mpeg', 'This was never a song.\n'.repeat(50));
export const emptyFile = (): TestFile => file('nothing.bvh', '', '');

// ---- leaders ----

/** Name, offset from the parent in centimetres, children. */
type Bone = readonly [string, readonly [number, number, number], readonly Bone[]];

const leg = (side: 'Left' | 'Right', x: number): Bone => [
  `${side}UpLeg`,
  [x, -6, 0],
  [[`${side}Leg`, [0, -42, 0], [[`${side}Foot`, [0, -41, -1], [[`${side}ToeBase`, [0, -7, 13], []]]]]]],
];
const arm = (side: 'Left' | 'Right', x: number): Bone => [
  `${side}Shoulder`,
  [x * 5, 10, 0],
  [
    [
      `${side}Arm`,
      [x * 13, 0, 0],
      [[`${side}ForeArm`, [x * 27, 0, 0], [[`${side}Hand`, [x * 25, 0, 0], []]]]],
    ],
  ],
];
const LEGS: readonly Bone[] = [leg('Left', 9), leg('Right', -9)];
const TORSO: Bone = [
  'Spine',
  [0, 11, 0],
  [
    [
      'Spine1',
      [0, 13, 0],
      [
        [
          'Spine2',
          [0, 13, 0],
          [arm('Left', 1), arm('Right', -1), ['Neck', [0, 15, 0], [['Head', [0, 11, 2], []]]]],
        ],
      ],
    ],
  ],
];

/** A made leader: steps from side to side, twice a second, and turns slowly. */
export interface LeaderOptions {
  readonly frames: number;
  readonly fps?: number;
  readonly legs?: boolean;
  readonly name?: string;
  /** Changes the motion, so that two leaders differ. */
  readonly sway?: number;
}

export function bvh({
  frames,
  fps = 30,
  legs = true,
  name = 'made leader.bvh',
  sway = 1,
}: LeaderOptions): TestFile {
  return file(name, '', bvhText({ frames, fps, legs, sway }));
}

export function bvhText({ frames, fps = 30, legs = true, sway = 1 }: LeaderOptions): string {
  const root: Bone = ['Hips', [0, 0, 0], legs ? [...LEGS, TORSO] : [TORSO]];
  const names: string[] = [];
  const hierarchy = `HIERARCHY\n${write(root, 'ROOT', '', names)}`;
  const rows = Array.from({ length: frames }, (_, frame) => row(names, frame / fps, sway));
  return `${hierarchy}MOTION\nFrames: ${frames}\nFrame Time: ${(1 / fps).toFixed(7)}\n${rows.join('\n')}\n`;
}

function write([name, offset, children]: Bone, kind: string, indent: string, names: string[]): string {
  names.push(name);
  const inner = `${indent}\t`;
  const channels = kind === 'ROOT' ? '6 Xposition Yposition Zposition ' : '3 ';
  const below = children.length
    ? children.map((child) => write(child, 'JOINT', inner, names)).join('')
    : `${inner}End Site\n${inner}{\n${inner}\tOFFSET 0 -2 4\n${inner}}\n`;
  return (
    `${indent}${kind} ${name}\n${indent}{\n${inner}OFFSET ${offset.join(' ')}\n` +
    `${inner}CHANNELS ${channels}Zrotation Xrotation Yrotation\n${below}${indent}}\n`
  );
}

/** Rotations in degrees, z x y, of each joint at a time. */
function row(names: readonly string[], t: number, sway: number): string {
  const step = Math.sin(2 * Math.PI * t);
  const turn = 40 * Math.sin(0.4 * t);
  const rotations: Record<string, readonly [number, number, number]> = {
    Hips: [2 * step * sway, 0, turn],
    LeftUpLeg: [0, -18 * Math.max(0, step) * sway, 0],
    LeftLeg: [0, 30 * Math.max(0, step), 0],
    RightUpLeg: [0, -18 * Math.max(0, -step) * sway, 0],
    RightLeg: [0, 30 * Math.max(0, -step), 0],
    LeftArm: [-70 + 12 * step * sway, 0, 0],
    RightArm: [70 + 12 * step * sway, 0, 0],
    LeftForeArm: [0, 0, -50],
    RightForeArm: [0, 0, 50],
    Spine: [-3 * step * sway, 3, 0],
  };
  const place = [25 * step * sway, 97 - 1.5 * Math.abs(step), 20 * Math.sin(0.7 * t)];
  const angles = names.flatMap((name) => rotations[name] ?? [0, 0, 0]);
  return [...place, ...angles].map((value) => value.toFixed(4)).join(' ');
}

/** A still dancer as a table of joints, who sways a little. */
export function csv(frames: number): TestFile {
  const sides = ['left', 'right'] as const;
  const places: Record<string, readonly [number, number, number]> = {
    pelvis: [0, 0.95, 0],
    spine1: [0, 1.06, 0],
    spine2: [0, 1.18, 0],
    spine3: [0, 1.24, 0],
    neck: [0, 1.4, 0],
    head: [0, 1.5, 0.02],
    ...Object.fromEntries(
      sides.flatMap((side, i): [string, [number, number, number]][] => {
        const sign = i === 0 ? 1 : -1;
        return [
          [`${side}_hip`, [sign * 0.09, 0.87, 0]],
          [`${side}_knee`, [sign * 0.1, 0.48, 0.02]],
          [`${side}_ankle`, [sign * 0.1, 0.08, 0]],
          [`${side}_foot`, [sign * 0.1, 0.03, 0.12]],
          [`${side}_collar`, [sign * 0.07, 1.32, 0]],
          [`${side}_shoulder`, [sign * 0.2, 1.34, 0]],
          [`${side}_elbow`, [sign * 0.24, 1.07, 0]],
          [`${side}_wrist`, [sign * 0.24, 0.85, 0.08]],
        ];
      }),
    ),
  };
  const names = Object.keys(places);
  const titles = ['time', ...names.flatMap((name) => ['x', 'y', 'z'].map((axis) => `${name}_${axis}`))];
  const rows = Array.from({ length: frames }, (_, frame) => {
    const sway = 0.1 * Math.sin(frame / 8);
    const values = Object.values(places).flatMap(([x, y, z]) => [x + sway * Math.min(1, y), y, z]);
    return [frame / 30, ...values].map((value) => value.toFixed(5)).join(',');
  });
  return file('table.csv', 'text/csv', [titles.join(','), ...rows, ''].join('\n'));
}

/** A leader that begins with its rest pose and ends in the middle of frame 41, as an interrupted download does. */
export function truncatedBvh(): TestFile {
  const lines = bvhText({ frames: 60 }).split('\n');
  const first = lines.findIndex((line) => line.startsWith('Frame Time')) + 1;
  const rest = lines[first]!.split(' ').map((_, column) => (column === 1 ? 97 : 0));
  const kept = [rest.join(' '), ...lines.slice(first + 1, first + 40), '1.5 97 -'];
  return file('truncated.bvh', '', [...lines.slice(0, first), ...kept].join('\n'));
}

/** Leaders that are invalid in ways that occur in real files. */
export const brokenLeaders = {
  truncated: (): TestFile => {
    const text = bvhText({ frames: 60 });
    return file('cut off.bvh', '', text.slice(0, text.indexOf('\n', text.indexOf('Frame Time')) + 20));
  },
  noLegs: (): TestFile => bvh({ frames: 60, legs: false, name: 'arms only.bvh' }),
  oneFrame: (): TestFile => bvh({ frames: 1, name: 'statue.bvh' }),
  notNumbers: (): TestFile => {
    const lines = bvhText({ frames: 60 }).split('\n');
    const first = lines.findIndex((line) => line.startsWith('Frame Time')) + 1;
    lines[first + 20] = (lines[first + 20] ?? '').replace(/^\S+/, 'NaN');
    return file('not numbers.bvh', '', lines.join('\n'));
  },
} as const;
