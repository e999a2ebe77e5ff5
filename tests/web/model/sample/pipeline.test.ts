/** From a leader clip and a song to the partner's solved motion, on the tiny model in onnxruntime's wasm build. */
import { afterAll, beforeAll, beforeEach, describe, expect, it } from 'vitest';
import type { ConditionInput } from '../../../../web/model/sample/graphs';
import type { GenerateRequest } from '../../../../web/model/sample/inputs';
import type { Preview } from '../../../../web/model/sample/results';
import { Pipeline } from '../../../../web/model/sample/pipeline';
import type { Progress } from '../../../../web/model/progress';
import type { ModelSession } from '../../../../web/model/load/session';
import type { Manifest } from '../../../../web/model/manifest';
import type { MotionClip } from '../../../../web/motion/skeleton/clip';
import { withFootLock } from '../../../../web/motion/contact/foot-lock';
import { holdHands } from '../../../../web/motion/contact/hand-hold';
import { solve } from '../../../../web/motion/fit/ik';
import { danceDistance } from '../../../../web/motion/skeleton/difference';
import { standingHeight } from '../../../../web/motion/skeleton/kinematics';
import { readVec, type Vec3, writeVec } from '../../../../web/motion/math/vec3';
import { bodyHeight } from '../../../../web/motion/skeleton/scale';
import { J, JOINT_COUNT } from '../../../../web/motion/skeleton/skeleton';
import { scaled } from '../../support/made-dancer';
import { maxDifference, type OpenedModel, openModel, TINY } from '../../support/open-model';

let model: OpenedModel;
/** Steps of a sampling in all tests but one, fewer than the tiny model has. */
const STEPS = 2;
let conditions: ConditionInput[];
let stepRuns: number;
/** The model's session with a note of what is asked of it. */
let observed: ModelSession;
let pipeline: Pipeline;

beforeAll(async () => {
  const opened = await openModel(TINY);
  model = { ...opened, manifest: withSteps(opened.manifest, STEPS) };
}, 60_000);
afterAll(() => model.session.release());
beforeEach(() => {
  conditions = [];
  stepRuns = 0;
  const { session } = model;
  observed = {
    ...session,
    condition(input) {
      conditions.push(input);
      return session.condition(input);
    },
    step(input) {
      stepRuns += 1;
      return session.step(input);
    },
  };
  pipeline = new Pipeline(model.manifest, observed, () => performance.now() / 1000);
});

function withSteps(manifest: Manifest, steps: number): Manifest {
  return { ...manifest, diffusion: { ...manifest.diffusion, steps } };
}

/** A leader as the page has read it. */
const loaded = (leader: MotionClip): Pick<GenerateRequest, 'leader' | 'fitted'> => ({
  leader,
  fitted: solve(leader),
});

/** The first frames of the golden leader, and features as long. */
function request(frames: number, changes: Partial<GenerateRequest> = {}): GenerateRequest {
  const { golden, manifest } = model;
  return {
    ...loaded({ fps: 30, frames, positions: golden.leader.slice(0, frames * 66) }),
    music: { features: golden.music.slice(0, frames * manifest.audio.features), frames },
    guidance: new Float32Array(6),
    musicGuidance: 0,
    variety: 1,
    seed: 1,
    ...changes,
  };
}

/** A leader carried along x at so many m/s, four metres there and back. */
function travelling(leader: MotionClip, speed: number): MotionClip {
  const along = (frame: number): number => Math.abs((((frame * speed) / 30) % 8) - 4);
  const positions = leader.positions.map((value, i) =>
    i % 3 === 0 ? value + along(Math.floor(i / 66)) : value,
  );
  return { ...leader, positions };
}

/** The golden song with a beat every so many frames. */
function beating(frames: number, gap: number): NonNullable<GenerateRequest['music']> {
  const count = Math.ceil(frames / gap);
  return { ...request(frames).music!, beats: Array.from({ length: count }, (_, i) => (i * gap) / 30) };
}

describe('Pipeline', () => {
  it.each([1, 2, 3, 4, 5, 119, 241, 483])(
    'generates as many frames as the leader has (%i)',
    async (frames) => {
      const start = performance.now();
      const { motion, seconds } = await pipeline.generate(request(frames));
      const all = (performance.now() - start) / 1000;
      expect(motion.frames).toBe(frames);
      expect(motion.positions).toHaveLength(frames * 66);
      expect(motion.positions.every(Number.isFinite)).toBe(true);
      expect(Object.values(seconds).every((time) => time >= 0)).toBe(true);
      expect(seconds.steps + seconds.decode + seconds.solve).toBeLessThanOrEqual(all);
    },
  );

  it('gives the same partner for the same seed and another for another', async () => {
    const [a, b, c] = [
      await pipeline.generate(request(121)),
      await pipeline.generate(request(121)),
      await pipeline.generate(request(121, { seed: 2 })),
    ];
    expect(b.motion.positions).toEqual(a.motion.positions);
    expect(maxDifference(c.motion.positions, a.motion.positions)).toBeGreaterThan(1e-3);
  });

  it('samples nothing again when weights change, up to the branches that they need first', async () => {
    const changes: Partial<GenerateRequest>[] = [
      { guidance: Float32Array.from([0, 0.5, 0, 0.5, 0, 0.5]) },
      { guidance: Float32Array.from([0.5, 0, 0.5, 0, 0.5, 0]) },
      { guidance: Float32Array.from([-0.5, 1, 0.5, 0, 0.5, 0]) },
      { musicGuidance: 2 },
      { musicGuidance: 5 },
      { variety: 0.5 },
      { variety: 2 },
      { musicGuidance: 1, variety: 1.5, guidance: new Float32Array(6).fill(0.25) },
      {},
    ];
    const all: Float32Array[] = [];
    const runs: number[] = [];
    await pipeline.generate(request(120));
    for (const weights of changes) {
      const before = stepRuns;
      all.push((await pipeline.generate(request(120, weights))).motion.positions);
      runs.push(stepRuns - before);
    }
    // The unconditional branch, the silent one, and those of the other seeds that have a mean.
    expect(runs).toEqual(
      [0, 1, 0, 1, 0, model.manifest.guidance.variety.seeds, 0, 0, 0].map((branches) => branches * STEPS),
    );
    for (const positions of all.slice(0, -1))
      expect(maxDifference(positions, all.at(-1)!)).toBeGreaterThan(1e-3);
    expect(conditions).toHaveLength(2);
  });

  it('gives all seeds the same coarse layer where there is no variety, and their own fine one', async () => {
    const { channels } = model.manifest.latent;
    const layer = (latents: Float32Array, index: number): Float32Array =>
      latents.filter((_, i) => Math.floor(i / channels) % 2 === index);
    const [one, two] = [
      await pipeline.generate(request(120, { variety: 0, seed: 11 })),
      await pipeline.generate(request(120, { variety: 0, seed: 12 })),
    ];
    expect(maxDifference(layer(one.latents, 0), layer(two.latents, 0))).toBeLessThan(1e-5);
    expect(maxDifference(layer(one.latents, 1), layer(two.latents, 1))).toBeGreaterThan(0.1);
    const { seeds } = model.manifest.guidance.variety;
    const mean = new Float32Array(one.latents.length / 2);
    for (let seed = 0; seed < seeds; seed++)
      layer((await pipeline.generate(request(120, { seed }))).latents, 0).forEach(
        (value, i) => (mean[i]! += value / seeds),
      );
    expect(maxDifference(layer(one.latents, 0), mean)).toBeLessThan(1e-5);
  });

  it('gives the dance the same body whatever the weights', async () => {
    const plain = await pipeline.generate(request(120));
    const guided = await pipeline.generate(request(120, { guidance: new Float32Array(6).fill(0.75) }));
    expect(guided.motion.offsets).toEqual(plain.motion.offsets);
    expect(guided.locked.offsets).toEqual(plain.motion.offsets);
  });

  it.each([
    [0, 0],
    [5.2, 0],
    [11, 0],
    [19.9, 0],
    // So fast that the partner steps.
    [11, 1.5],
    [19.9, 1.5],
  ])('shows the part in view first, as it is in the whole (at %f s, %f m/s)', async (at, travel) => {
    const weights = {
      guidance: new Float32Array(6).fill(0.5),
      musicGuidance: 2,
      ...loaded(travelling(request(600).leader, travel)),
      music: beating(600, 13),
    };
    const playhead = { frame: at * 30, at: 0, rate: 0 };
    const previews: Preview[] = [];
    const onPreview = (preview: Preview): void => void previews.push(preview);
    const whole = await pipeline.generate(request(600, weights), { playhead, onPreview });
    expect(previews).toHaveLength(1);
    const [{ from, motion, locked }] = previews as [Preview];
    const moment = Math.min(at * 30, 599);
    expect(from).toBeLessThanOrEqual(moment);
    expect(from + motion.frames).toBeGreaterThan(moment);
    // A third of a second before it is shown too, and more than two seconds in all, at the end of the dance as well.
    expect(from).toBeLessThanOrEqual(Math.max(0, moment - 9));
    expect(motion.frames).toBeGreaterThan(60);
    const inWhole = (values: Float32Array): Float32Array =>
      values.subarray(from * 66, (from + motion.frames) * 66);
    expect(maxDifference(motion.positions, inWhole(whole.motion.positions))).toBeLessThan(1e-4);
    expect(maxDifference(locked.positions, inWhole(whole.locked.positions))).toBeLessThan(1e-4);
  });

  it.each([
    [150, 0],
    [151, 1],
  ])('shows no part of a dance of five seconds first (%i frames)', async (frames, count) => {
    const previews: Preview[] = [];
    const onPreview = (preview: Preview): void => void previews.push(preview);
    await pipeline.generate(request(frames), { playhead: { frame: 60, at: 0, rate: 0 }, onPreview });
    expect(previews).toHaveLength(count);
  });

  it('looks for the part in view when it begins to make it, and makes no whole that is no longer wanted', async () => {
    await pipeline.generate(request(600));
    let now = 100;
    const decoded: number[] = [];
    const session: ModelSession = {
      ...model.session,
      step: (input) => {
        now = 103;
        return model.session.step(input);
      },
      decode: (input) => {
        decoded.push(input.leader.length / 66);
        return model.session.decode(input);
      },
    };
    const late = new Pipeline(model.manifest, session, () => now);
    const controller = new AbortController();
    let from = NaN;
    const result = late.generate(request(600), {
      signal: controller.signal,
      playhead: { frame: 60, at: 100, rate: 30 },
      onPreview: (preview) => {
        ({ from } = preview);
        controller.abort(new Error('newer weights'));
      },
    });
    await expect(result).rejects.toThrow('newer weights');
    // Three seconds after frame 60 it is at frame 150.
    expect(from).toBeLessThanOrEqual(150);
    expect(from).toBeGreaterThan(120);
    // Of the 600 frames only those are decoded that the part depends on.
    expect(decoded).toHaveLength(1);
    expect(decoded[0]).toBeLessThan(420);
  });

  it('brings the leader to the reference height and the partner back to the size of the leader', async () => {
    const { leader } = request(120);
    const large = scaled(leader, 1.3);
    const [plain, enlarged] = [
      await pipeline.generate(request(120, { leader })),
      await pipeline.generate(request(120, loaded(large))),
    ];
    const seen: MotionClip = { fps: 30, frames: 120, positions: conditions[0]?.leader ?? new Float32Array() };
    expect(bodyHeight(seen)).toBeCloseTo(model.manifest.skeleton.reference_height, 4);
    const expected = plain.motion.positions.map((value) => value * 1.3);
    // The solver's own bone lengths scale with the body, up to its convergence; the height up to which toes stand does
    // not, and this untrained partner floats.
    expect(maxDifference(enlarged.motion.positions, expected)).toBeLessThan(0.015);
  });

  it('computes the memory once per leader, song and role', async () => {
    const first = request(120);
    await pipeline.generate(first);
    await pipeline.generate({
      ...first,
      guidance: new Float32Array(6).fill(1),
      seed: 3,
    });
    expect(conditions).toHaveLength(1);
    // The same numbers in other arrays, as after crossing to a worker, are the same input.
    await pipeline.generate(request(120));
    expect(conditions).toHaveLength(1);
    await pipeline.generate({ ...first, role: 'leader' });
    const other = first.music?.features.map((value) => value + 1) ?? new Float32Array();
    await pipeline.generate({ ...first, music: { features: other, frames: 120 }, role: 'leader' });
    await pipeline.generate({ ...first, music: null, role: 'leader' });
    await pipeline.generate({ ...first, ...loaded(request(119).leader) });
    expect(conditions.map(({ role }) => role)).toEqual([0, 1, 1, 1, 0]);
    // A song that ends earlier is another one, even if its features are zeros as those of silence.
    for (const frames of [120, 60]) {
      const features = new Float32Array(frames * model.manifest.audio.features);
      await pipeline.generate({ ...first, music: { features, frames } });
    }
    expect(conditions).toHaveLength(7);
  });

  it('marks silence before the model: no song, and a song shorter than the dance', async () => {
    await pipeline.generate(request(120, { music: null }));
    const { music } = request(50);
    await pipeline.generate(request(120, { music }));
    // Nothing tells a dance without a song from one whose song has no weight.
    const before = stepRuns;
    await pipeline.generate(request(120, { music: null, musicGuidance: 5, seed: 9 }));
    expect(stepRuns - before).toBe(STEPS);
    conditions.pop();
    const heard = conditions.map(({ musicValid }) => musicValid.reduce((sum, v) => sum + v, 0));
    expect(heard).toEqual([0, 50]);
    expect(conditions[1]?.musicValid[49]).toBe(1);
  });

  it('uses only the part of a longer song that the dance lasts', async () => {
    await pipeline.generate(request(50, { music: request(120).music }));
    expect(conditions[0]?.music).toHaveLength(52 * model.manifest.audio.features);
    expect(conditions[0]?.musicValid.reduce((sum, v) => sum + v, 0)).toBe(52);
  });

  it('decodes the coarse layer alone from the latents of a reaction, as long and as large as the whole', async () => {
    const large = request(121, loaded(scaled(request(121).leader, 1.3)));
    const { motion, latents } = await pipeline.generate(large);
    expect(latents).toHaveLength(31 * model.manifest.latent.layers.length * model.manifest.latent.channels);
    const asked: number[][] = [];
    const { session, manifest } = model;
    const watched: ModelSession = {
      ...session,
      decode(input) {
        asked.push([...input.gains]);
        return session.decode(input);
      },
    };
    const runs = stepRuns;
    const alone = new Pipeline(manifest, watched, () => 0);
    const { motion: coarse, locked } = await alone.coarse({ ...large, latents });
    expect(asked.map(String)).toEqual(['1,0,1,0,1,0']);
    expect(stepRuns).toBe(runs);
    expect(coarse.frames).toBe(motion.frames);
    expect(maxDifference(coarse.positions, motion.positions)).toBeGreaterThan(1e-4);
    expect(locked).toEqual(withFootLock(coarse));
    // Without its fine layer a reaction is its own coarse reaction.
    const width = manifest.latent.channels;
    const plain = latents.map((value, i) => (Math.floor(i / width) % 2 === 0 ? value : value + 0.5));
    const again = await pipeline.coarse({ ...large, latents: plain });
    expect(again.motion.positions).toEqual(coarse.positions);
  });

  it('steps to the beats of the song, whole or coarse, beside a leader who travels', async () => {
    // What is decoded is the leader, a metre beside itself: it slides along on both feet.
    const session: ModelSession = {
      ...model.session,
      decode: ({ leader }) => Promise.resolve(leader.map((value, i) => (i % 3 === 2 ? value + 1 : value))),
    };
    const slides = new Pipeline(model.manifest, session, () => 0);
    const dance = { ...request(240), ...loaded(travelling(request(240).leader, 1.4)) };
    for (const [gap, start] of [
      [8, 0],
      [13, 0],
      [13, 6],
    ] as const) {
      const asked = { ...dance, music: { ...beating(240, gap), start } };
      const { motion, latents } = await slides.generate(asked);
      const { motion: coarse } = await slides.coarse({ ...asked, latents });
      for (const { positions } of [motion, coarse]) {
        /** Of the left foot, m/s. */
        const speed = (frame: number): number => {
          const at = (t: number): Vec3 => readVec(positions, t * JOINT_COUNT + J.left_ankle);
          const [a, b] = [at(frame), at(frame + 1)];
          return 30 * Math.hypot(b[0] - a[0], b[2] - a[2]);
        };
        const frames = Array.from({ length: 180 }, (_, i) => 30 + i);
        const mean = (flies: boolean): number => {
          const during = frames.filter((frame) => Math.floor((frame - start) / gap) % 2 === Number(flies));
          return during.reduce((sum, frame) => sum + speed(frame), 0) / during.length;
        };
        expect(mean(true), `${gap} frames from ${start} on`).toBeGreaterThan(1.5 * mean(false));
      }
    }
  });

  it('keeps the partner, whole or coarse, out of the body of the leader', async () => {
    // What is decoded is the leader, a hand's breadth beside itself.
    const session: ModelSession = {
      ...model.session,
      decode: ({ leader }) => Promise.resolve(leader.map((value, i) => (i % 3 === 0 ? value + 0.1 : value))),
    };
    const inside = new Pipeline(model.manifest, session, () => 0);
    const { leader, ...rest } = request(120);
    const { motion, locked, latents } = await inside.generate({ leader, ...rest });
    const coarse = await inside.coarse({ leader, ...rest, latents });
    const apart = [motion, locked, coarse.motion].map(({ positions }) => {
      let [least, most] = [Infinity, 0];
      for (let frame = 0; frame < leader.frames; frame++) {
        const at = 3 * (frame * JOINT_COUNT + J.spine3);
        const gap = [0, 1, 2].map((axis) => positions[at + axis]! - leader.positions[at + axis]!);
        [least, most] = [Math.min(least, Math.hypot(...gap)), Math.max(most, Math.hypot(...gap))];
      }
      return { least, most };
    });
    for (const { least, most } of apart) {
      expect(least).toBeGreaterThan(0.18);
      expect(most).toBeLessThan(0.8);
    }
  });

  it('gives the partner the height that is asked for, without another pass of the network', async () => {
    let passes = 0;
    const { session, manifest } = model;
    const watched: ModelSession = {
      ...session,
      step: (input) => ((passes += 1), session.step(input)),
      decode: (input) => ((passes += 1), session.decode(input)),
    };
    const counted = new Pipeline(manifest, watched, () => 0);
    const plain = request(241);
    const { latents, ...asDecoded } = await counted.generate(plain);
    const before = passes;
    const given = latents.slice();
    const tall = await counted.generate(
      { ...plain, height: 1.9 },
      {
        playhead: { frame: 0, at: 0, rate: 0 },
        onPreview: () => expect.unreachable('the whole is there as soon'),
      },
    );
    expect(passes).toBe(before);
    expect(standingHeight(tall.motion.offsets)).toBeCloseTo(1.9, 5);
    expect(tall.latents).toEqual(latents);
    // The page may do with them what it wants.
    tall.latents.fill(0);
    expect(latents).toEqual(given);
    expect(tall.motion.positions).toEqual(
      (await new Pipeline(manifest, session, () => 0).generate({ ...plain, height: 1.9 })).motion.positions,
    );
    expect((await counted.generate(plain)).motion.positions).toEqual(asDecoded.motion.positions);
    const coarse = await counted.coarse({ ...plain, latents, height: 1.9 });
    expect(standingHeight(coarse.motion.offsets)).toBeCloseTo(1.9, 5);
    // One pass of the decoder, which does not push the dance out of memory.
    await counted.generate({ ...plain, height: 1.8 });
    expect(passes).toBe(before + 1);
  });

  it('lets hands hold the leader’s or leaves them as generated, without another pass of the network', async () => {
    let passes = 0;
    const { session, manifest } = model;
    const decode: ModelSession['decode'] = (input) => ((passes += 1), session.decode(input));
    const pipeline = new Pipeline(manifest, { ...session, decode }, () => 0);
    const alone = request(241);
    const apart = await pipeline.generate(alone);
    // A leader whose forearms are where the partner's are, and swing about there.
    const positions = alone.leader.positions.slice();
    for (let frame = 0; frame < 241; frame++)
      for (const joint of [J.left_elbow, J.left_wrist, J.right_elbow, J.right_wrist]) {
        const [x, y, z] = readVec(apart.motion.positions, frame * JOINT_COUNT + joint);
        writeVec(positions, frame * JOINT_COUNT + joint, [x + 0.1 * Math.sin(frame / 2), y, z]);
      }
    const plain = { ...alone, leader: { ...alone.leader, positions } };
    const held = await pipeline.generate(plain);
    const before = passes;
    const free = await pipeline.generate({ ...plain, holdHands: false });
    expect(passes).toBe(before);
    expect(maxDifference(free.motion.positions, held.motion.positions)).toBeGreaterThan(0.0005);
    expect(holdHands(free.motion, plain.leader).positions).toEqual(held.motion.positions);
    const coarse = { ...plain, latents: held.latents };
    const [one, other] = [
      await pipeline.coarse(coarse),
      await pipeline.coarse({ ...coarse, holdHands: false }),
    ];
    expect(maxDifference(one.motion.positions, other.motion.positions)).toBeGreaterThan(0.0005);
  });

  it.each(['reactor', 'leader'] as const)(
    'makes a %s in the proportion that the manifest has, to leaders of every size',
    async (role) => {
      const { manifest, session } = model;
      const skeleton = { ...manifest.skeleton, reactor_height: 0.9 * manifest.skeleton.reference_height };
      const known = new Pipeline({ ...manifest, skeleton }, session, () => 0);
      for (const size of [1, 1.2]) {
        const plain = request(120, { role });
        const leader = scaled(plain.leader, size);
        const { motion } = await known.generate({ ...plain, ...loaded(leader) });
        const proportion = bodyHeight(motion) / bodyHeight(leader);
        expect(proportion).toBeCloseTo(role === 'reactor' ? 0.9 : 1 / 0.9, 4);
      }
    },
  );

  it.each(['reactor', 'leader'] as const)('gives a %s the body of that role', async (role) => {
    const { manifest, session } = model;
    // The leader's body with longer upper arms, not only of another size than the reactor's.
    const bodies = {
      reactor: manifest.skeleton.bodies.reactor,
      leader: manifest.skeleton.bodies.reactor.map((offset, joint) =>
        joint === J.left_elbow || joint === J.right_elbow ? offset.map((value) => 1.5 * value) : offset,
      ),
    };
    const skeleton = { ...manifest.skeleton, bodies };
    const plain = request(20, { role });
    const { motion } = await new Pipeline({ ...manifest, skeleton }, session, () => 0).generate(plain);
    const thigh = (offsets: Float32Array): number => Math.hypot(...readVec(offsets, J.left_knee));
    const body = Float32Array.from(bodies[role].flat());
    const size = thigh(motion.offsets) / thigh(body);
    expect(
      maxDifference(
        motion.offsets,
        body.map((value) => value * size),
      ),
    ).toBeLessThan(1e-5);
  });

  it('refuses latents of another dance, and stops decoding when it is cancelled', async () => {
    const { latents } = await pipeline.generate(request(120));
    await expect(pipeline.coarse({ ...request(200), latents })).rejects.toMatchObject({
      code: 'bad-request',
      message: expect.stringMatching(/not made for this leader/) as string,
    });
    const coarse = pipeline.coarse({ ...request(120), latents }, { signal: AbortSignal.abort() });
    await expect(coarse).rejects.toThrow(/abort/i);
  });

  it.each<[string, Partial<GenerateRequest>]>([
    ['one branch', {}],
    [
      'all branches and the mean',
      { musicGuidance: 8, guidance: new Float32Array(6).fill(0.5), variety: 0.5 },
    ],
  ])('reports progress that ascends to 1 (%s)', async (_, changes) => {
    const seen: Progress[] = [];
    await pipeline.generate(request(483, changes), { onProgress: (progress) => seen.push(progress) });
    const stages = seen.map(({ stage }) => stage);
    expect(stages.filter((stage, i) => stage !== stages[i - 1])).toEqual(['condition', 'step']);
    const fractions = seen.map(({ fraction }) => fraction);
    expect(fractions).toEqual([...fractions].sort((a, b) => a - b));
    expect(fractions.at(-1)).toBe(1);
  });

  it('stops between two steps when it is cancelled, and works on afterwards', async () => {
    const controller = new AbortController();
    const long = new Pipeline(withSteps(model.manifest, 10), observed, () => 0);
    const result = long.generate(request(120), {
      signal: controller.signal,
      onProgress: ({ stage }) => {
        if (stage === 'step' && stepRuns === 3) setTimeout(() => controller.abort());
      },
    });
    await expect(result).rejects.toThrow(/abort/i);
    expect(stepRuns).toBe(3);
    expect((await long.generate(request(120))).motion.frames).toBe(120);
  });

  it.each<[string, () => Partial<GenerateRequest>, RegExp]>([
    ['a short guidance', () => ({ guidance: new Float32Array(5) }), /not 3 x 2 numbers/],
    ['music guidance that is no number', () => ({ musicGuidance: NaN }), /music is not a number/],
    ['height that no dancer has', () => ({ height: 3 }), /height of 3 m is not between/],
    ['variety that is no number', () => ({ variety: NaN }), /variety is not a number/],
    ['a seed with a fraction', () => ({ seed: 0.5 }), /seed 0.5/],
    ['no frames', () => ({ leader: { fps: 30, frames: 0, positions: new Float32Array() } }), /empty/],
    ['another frame rate', () => ({ leader: { ...request(4).leader, fps: 60 } }), /60 frames per second/],
    [
      'a position that is not a number',
      () => ({ ...request(4), leader: { fps: 30, frames: 4, positions: new Float32Array(264).fill(NaN) } }),
      /not a number/,
    ],
    [
      'a body without size',
      () => ({ ...request(4), leader: { fps: 30, frames: 4, positions: new Float32Array(264) } }),
      /no body height/,
    ],
    ['other features', () => ({ music: { features: new Float32Array(7), frames: 1 } }), /54 features/],
  ])('refuses %s in a sentence', async (_, changes, message) => {
    const result = pipeline.generate(request(120, changes()));
    await expect(result).rejects.toMatchObject({
      name: 'AppError',
      code: 'bad-request',
      message: expect.stringMatching(message) as string,
    });
    expect(conditions).toHaveLength(0);
  });

  it('reports an output of the model that is not finite', async () => {
    const { session, manifest } = model;
    const broken = {
      ...session,
      decode: () => Promise.resolve(new Float32Array(120 * 66).fill(NaN)),
    };
    const result = new Pipeline(manifest, broken, () => 0).generate(request(120));
    await expect(result).rejects.toMatchObject({ code: 'not-finite' });
  });
});

describe('the seeds that differ most', () => {
  const seeds = [1, 2, 3, 4, 5];
  /** A pipeline on the tiny model whose clock goes on by a second with every step. */
  const timed = (): Pipeline => {
    let steps = 0;
    const { session, manifest } = model;
    const ticking: ModelSession = {
      ...session,
      step: (input) => {
        steps += 1;
        stepRuns += 1;
        return session.step(input);
      },
    };
    return new Pipeline(manifest, ticking, () => steps);
  };

  it('are apart as their dances are, whose sampling is kept', async () => {
    const alone = request(120);
    const chosen = await pipeline.differingSeeds({ request: alone, seeds, count: 3, seconds: 1000 });
    const sampled = stepRuns;
    const dances: Float32Array[] = [];
    for (const seed of seeds) dances.push((await pipeline.generate({ ...alone, seed })).motion.positions);
    expect(stepRuns).toBe(sampled);
    const nearest = (list: readonly number[]): number => {
      const [a, b, c] = list.map((seed) => dances[seed - 1]!) as [Float32Array, Float32Array, Float32Array];
      return Math.min(danceDistance(a, b), danceDistance(a, c), danceDistance(b, c));
    };
    const all = seeds.flatMap((a) =>
      seeds.flatMap((b) => seeds.filter((c) => a < b && b < c).map((c) => [a, b, c])),
    );
    expect(all).toHaveLength(10);
    // Solving moves joints by a few millimetres.
    expect(nearest(chosen)).toBeGreaterThan(Math.max(...all.map(nearest)) - 0.004);
    expect(nearest(chosen)).toBeGreaterThan(Math.min(...all.map(nearest)));
  });

  it('are of fewer seeds where there is no time for more, but never of too few', async () => {
    const shares: number[] = [];
    const onProgress = (share: number): void => void shares.push(share);
    const wanted = { request: request(120, { musicGuidance: 8 }), seeds, count: 3 };
    expect(await timed().differingSeeds({ ...wanted, seconds: 0 }, { onProgress })).toEqual([1, 2, 3]);
    expect(shares.at(-1)).toBe(0.6);
    expect(shares).toEqual(shares.toSorted((a, b) => a - b));
    expect(shares.length).toBeGreaterThan(6);
    // Four dances of two branches each.
    await timed().differingSeeds({ ...wanted, seconds: 4 * 2 * STEPS }, { onProgress });
    expect(shares.at(-1)).toBe(0.8);
  });

  it('are given up when cancelled', async () => {
    const controller = new AbortController();
    const result = pipeline.differingSeeds(
      { request: request(120), seeds, count: 3, seconds: 1000 },
      { signal: controller.signal, onProgress: (share) => share >= 0.2 && controller.abort() },
    );
    await expect(result).rejects.toThrow(/abort/i);
    expect(stepRuns).toBe(STEPS);
  });
});
