/** From blended latents to the solved dancer: a whole dance, or a part of it as it is in the whole. */
import { yieldToEvents } from '../../common/yield-to-events';
import { besidePartner } from '../../motion/contact/beside-partner';
import { resized } from '../../motion/contact/body-size';
import { withFootLock } from '../../motion/contact/foot-lock';
import { solve } from '../../motion/fit/ik';
import type { MotionClip, SolvedMotion } from '../../motion/skeleton/clip';
import type { ModelSession } from '../load/session';
import type { Manifest } from '../manifest';
import { bodyFactor } from './body-factor';
import { decodeClip, type DecodeOptions } from './decoder';
import type { ModelInput, SolveSettings, Source } from './inputs';
import type { GeneratedMotion } from './results';

/** What is decoded, latents and gains as in `DecodeInput`, the leader at their own size, who dances, and how it is solved. */
export interface Dance extends SolveSettings, Pick<Source, 'role'> {
  readonly latents: Float32Array;
  readonly gains: Float32Array;
  readonly input: ModelInput;
  readonly leader: MotionClip;
}

/** Decodes and solves dances on a session. */
export class Assembler {
  /** The whole dance that was decoded last: other settings of solving need no pass of the network. */
  #decoded: { readonly latents: Float32Array; readonly clip: MotionClip } | undefined;

  constructor(
    readonly manifest: Manifest,
    readonly session: ModelSession,
  ) {}

  /** The whole dance. `onDecoded` is called between decoding and solving. */
  async whole(dance: Dance, signal?: AbortSignal, onDecoded?: () => void): Promise<GeneratedMotion> {
    const clip =
      this.#decoded?.latents === dance.latents ? this.#decoded.clip : await this.decode(dance, { signal });
    this.#decoded = { latents: dance.latents, clip };
    onDecoded?.();
    return this.#finished(clip, dance, signal);
  }

  /** A whole dance that is asked for beside the last one, which stays decoded. */
  async beside(dance: Dance, signal?: AbortSignal): Promise<GeneratedMotion> {
    return this.#finished(await this.decode(dance, { signal }), dance, signal);
  }

  /**
   * Some seconds of a dance, as they are in the whole to a millimetre, and feet that come near each other to two
   * centimetres, because steps are chosen that keep them apart. On each side the decoder's receptive field is decoded and
   * solved with them and cut off: within it the ends of a clip fade from decoded joints and from the shifts of locked feet
   * and against collisions.
   * @param from first frame; rounded down to where a part can begin
   * @param length frames from there on; fewer at the end of the dance
   */
  async part(
    dance: Dance,
    from: number,
    length: number,
  ): Promise<GeneratedMotion & { readonly from: number }> {
    const { leader } = dance;
    const { stride, receptive_field } = this.manifest.latent;
    const down = (frame: number): number => Math.max(0, Math.floor(frame / stride) * stride);
    const margin = receptive_field.decode * stride;
    const first = down(from);
    const end = Math.min(leader.frames, Math.ceil(from + length));
    const begin = down(first - margin);
    const range = { start: begin / stride, end: Math.ceil(Math.min(leader.frames, end + margin) / stride) };
    const clip = await this.decode(dance, { range, overlap: 0 });
    const motion = this.#solve(clip, dance, begin);
    const locked = withFootLock(motion);
    const inner = (solved: SolvedMotion): SolvedMotion => partOf(solved, first - begin, end - begin);
    return { from: first, motion: inner(motion), locked: inner(locked) };
  }

  /** Joints at the leader's size. */
  async decode({ latents, gains, input, leader }: Dance, options: DecodeOptions): Promise<MotionClip> {
    const { skeleton, latent } = this.manifest;
    const request = { latents, gains, leader: input.leader, role: input.condition.role };
    const joints = await decodeClip(this.session, this.manifest, request, options);
    const { start, end } = options.range ?? { start: 0, end: Infinity };
    // The last latent frame may reach beyond the dance.
    const frames = Math.min(leader.frames, end * latent.stride) - start * latent.stride;
    const positions = joints
      .subarray(0, frames * skeleton.joints.length * 3)
      .map((value) => value / input.scale);
    return { fps: leader.fps, frames, positions };
  }

  async #finished(clip: MotionClip, dance: Dance, signal?: AbortSignal): Promise<GeneratedMotion> {
    await yieldToEvents(signal);
    const motion = this.#solve(clip, dance, 0);
    await yieldToEvents(signal);
    return { motion, locked: withFootLock(motion) };
  }

  /**
   * Gives the dancer their size, fits the body to the joints, and lets it keep to what it does beside the other dancer's
   * (see `besidePartner`).
   * @param from the clip's first frame in the dance
   */
  #solve(clip: MotionClip, dance: Dance, from: number): SolvedMotion {
    const { skeleton, quality } = this.manifest;
    const { scale, steps } = dance.input;
    const leader = partOfClip(dance.leader, from, clip.frames);
    const offsets = Float32Array.from(
      skeleton.bodies[dance.role ?? 'reactor'].flat(),
      (value) => value / scale,
    );
    const factor = bodyFactor(offsets, scale, dance, skeleton);
    const solved = solve(
      resized(clip, factor, leader, skeleton.floor.toe_rest),
      offsets.map((value) => value * factor),
    );
    const stepsThere = steps.subarray(from, from + clip.frames);
    return besidePartner(solved, leader, quality, stepsThere, { holding: dance.holdHands });
  }
}

/** Frames of a clip without copying. */
function partOfClip({ fps, positions, frames }: MotionClip, from: number, length: number): MotionClip {
  const width = positions.length / frames;
  return { fps, frames: length, positions: positions.subarray(from * width, (from + length) * width) };
}

function partOf(motion: SolvedMotion, from: number, to: number): SolvedMotion {
  const cut = (values: Float32Array): Float32Array => {
    const width = values.length / motion.frames;
    return values.slice(from * width, to * width);
  };
  const { root, rotations, positions } = motion;
  return {
    ...motion,
    frames: to - from,
    root: cut(root),
    rotations: cut(rotations),
    positions: cut(positions),
  };
}
