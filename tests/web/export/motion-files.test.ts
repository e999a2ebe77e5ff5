import { unzipSync } from 'fflate';
import { expect, test, vi } from 'vitest';
import {
  atFrameRate,
  estimateBytes,
  FRAME_RATES,
  type MotionFormat,
  motionExtension,
  partOf,
  writeMotion,
} from '../../../web/export/client';
import { npyBytes } from '../../../web/export/npy';
import { writeNpz } from '../../../web/export/npz';
import { add, distance, readVec, scale } from '../../../web/motion/math/vec3';
import { leaderBvh } from '../support/leader-bvh';
import { JOINT_COUNT, PARENTS, SMPL22 } from '../../../web/motion/skeleton/skeleton';
import { madeDance } from '../support/made-dance';

const bytes = async (file: Promise<Blob>): Promise<Uint8Array> =>
  new Uint8Array(await (await file).arrayBuffer());

test('one dancer is a BVH file, two are an archive with one each', async () => {
  const dance = madeDance(40, 'leader', 'reactor');
  expect(motionExtension('bvh', 2)).toBe('-bvh.zip');
  const nameOf = (role: string): string => `salsa_${role}.bvh`;
  const archive = unzipSync(await bytes(writeMotion('bvh', dance, 'dark', nameOf)));
  expect(Object.keys(archive)).toEqual(['salsa_leader.bvh', 'salsa_reactor.bvh']);
  for (const { role, motion } of dance.dancers) {
    const { clip } = leaderBvh(new TextDecoder().decode(archive[nameOf(role)]));
    clip.positions.forEach((value, i) => expect(value).toBeCloseTo(motion.positions[i]!, 4));
  }
  const one = await bytes(writeMotion('bvh', madeDance(40, 'reactor'), 'dark'));
  expect(new TextDecoder().decode(one)).toBe(new TextDecoder().decode(archive[nameOf('reactor')]));
});

test('JSON has its metadata and every joint to a tenth of a millimetre', async () => {
  const dance = madeDance(33, 'reactor');
  const read = JSON.parse(await (await writeMotion('json', dance, 'dark')).text()) as Record<string, unknown>;
  expect(read).toMatchObject({
    units: { position: 'metres', time: 'seconds' },
    fps: 30,
    frames: 33,
    dancers: ['reactor'],
    joints: [...SMPL22],
    ...dance.about,
  });
  const { reactor, leader } = read['positions'] as Record<string, number[][][] | undefined>;
  expect(leader).toBeUndefined();
  expect(reactor).toHaveLength(33);
  const flat = reactor!.flat(2);
  dance.dancers[0]!.motion.positions.forEach((value, i) => expect(flat[i]).toBeCloseTo(value, 4));
});

test('a part of a dance says where the song begins in it', () => {
  const dance = { ...madeDance(40, 'reactor'), about: { ...madeDance(40, 'reactor').about, shift: 5 } };
  const part = partOf(dance, 10, 30);
  expect(part.about.shift).toBe(-5);
  expect(part.dancers[0]!.motion.frames).toBe(20);
  expect(part.dancers[0]!.motion.positions[0]).toBe(dance.dancers[0]!.motion.positions[10 * JOINT_COUNT * 3]);
  expect(partOf({ ...dance, about: { ...dance.about, song: null } }, 10, 30).about.shift).toBe(5);
  expect(partOf(dance, 0, 40)).toBe(dance);
});

test('shapes of arrays are tuples of Python, also those of one length and of none', () => {
  const header = (shape: number[], data: Float64Array): string =>
    new TextDecoder('latin1').decode(npyBytes({ shape, data }));
  expect(header([2], Float64Array.of(1, 2))).toContain("'shape': (2,)");
  expect(header([1, 2], Float64Array.of(1, 2))).toContain("'shape': (1, 2)");
  expect(header([], Float64Array.of(1))).toContain("'shape': ()");
});

test('the same dance gives the same NPZ file on every day', () => {
  const writtenOn = (day: string): Uint8Array => {
    vi.useFakeTimers({ toFake: ['Date'], now: new Date(day) });
    return writeNpz(madeDance(20, 'reactor'));
  };
  try {
    expect(writtenOn('2026-03-01')).toEqual(writtenOn('2027-10-31'));
  } finally {
    vi.useRealTimers();
  }
});

test.each<[MotionFormat, number]>([
  ['bvh', 0.03],
  ['npz', 0],
  ['json', 0.03],
])('the size of %s is estimated before it is written', async (format, tolerance) => {
  for (const roles of [['reactor'], ['leader', 'reactor']] as const) {
    const dance = madeDance(400, ...roles);
    const { size } = await writeMotion(format, dance, 'dark');
    // The compression of text in an archive is only known roughly.
    const within = format === 'bvh' && roles.length > 1 ? 0.1 : tolerance;
    expect(Math.abs(estimateBytes(format, dance) / size - 1)).toBeLessThanOrEqual(within);
  }
});

test.each(FRAME_RATES)(
  '%d frames a second: as long, at the same places, with bones of the same length',
  async (rate) => {
    const dance = madeDance(91, 'leader', 'reactor');
    const written = atFrameRate({ ...dance, about: { ...dance.about, shift: 15 } }, rate);
    expect(written.about.shift).toBeCloseTo(rate / 2, 6);
    const fps = unzipSync(writeNpz(written))['fps.npy']!;
    expect(new Float64Array(fps.slice(-8).buffer)).toEqual(Float64Array.of(rate));
    const json = JSON.parse(await (await writeMotion('json', written, 'dark')).text()) as object;
    expect(json).toMatchObject({ fps: rate, frames: 3 * rate + 1 });
    written.dancers.forEach(({ motion }, i) => {
      const before = dance.dancers[i]!.motion;
      expect(motion).toMatchObject({ fps: rate, frames: 3 * rate + 1 });
      // Whole seconds are frames at every rate.
      for (let second = 0; second <= 3; second++)
        for (let k = 0; k < JOINT_COUNT * 3; k++) {
          const value = motion.positions[second * rate * JOINT_COUNT * 3 + k];
          expect(value).toBeCloseTo(before.positions[second * 30 * JOINT_COUNT * 3 + k]!, 5);
        }
      for (let frame = 0; frame < motion.frames; frame++) {
        const at = (joint: number) => (frame * JOINT_COUNT + joint) * 3;
        for (let joint = 1; joint < JOINT_COUNT; joint++) {
          const bone = (of: Float32Array, a: number, b: number): number =>
            Math.hypot(of[a]! - of[b]!, of[a + 1]! - of[b + 1]!, of[a + 2]! - of[b + 2]!);
          const length = Math.hypot(...motion.offsets.subarray(joint * 3, joint * 3 + 3));
          expect(bone(motion.positions, at(joint), at(PARENTS[joint]!))).toBeCloseTo(length, 5);
        }
      }
      // Halfway between two frames every joint is in their middle, but for the arc on which it goes there.
      if (rate === 60)
        for (let joint = 0; joint < JOINT_COUNT; joint++) {
          const [start, end] = [
            readVec(before.positions, joint),
            readVec(before.positions, JOINT_COUNT + joint),
          ];
          const middle = scale(add(start, end), 0.5);
          const off = distance(readVec(motion.positions, JOINT_COUNT + joint), middle);
          expect(off).toBeLessThan(0.1 * distance(start, end));
        }
    });
  },
);

test.each(FRAME_RATES)('%d frames a second: the last frame is not after the end of the dance', (rate) => {
  for (const frames of [90, 92, 93, 94]) {
    const end = (frames - 1) / 30;
    const { motion } = atFrameRate(madeDance(frames, 'reactor'), rate).dancers[0]!;
    const last = (motion.frames - 1) / rate;
    expect(last).toBeLessThanOrEqual(end + 1e-9);
    expect(last).toBeGreaterThan(end - 1 / rate);
  }
});
