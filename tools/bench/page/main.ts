/** The browser half of the bench: the app's own modules, timed on the scene that the Python half made. */
import { musicFeatures } from '../../../web/audio/features';
import { readRecipe } from '../../../web/audio/recipe';
import {
  createGenerator,
  type Generator,
  type GenerateRequest,
  type Manifest,
  type Preference,
  secondsNow,
} from '../../../web/model/client';
import { readNpz } from '../../../web/model/load/npz';
import { solve } from '../../../web/motion/fit/ik';
import { unitGains } from '../../../web/model/sample/blend';

/**
 * Stages of a new dance without guidance: features, steps (condition included), decode and solve; `branches`
 * are the steps of all three branches. Then a weight is changed: seconds until the part in view is there, and until the
 * whole dance is.
 */
export type Seconds = Record<
  'features' | 'steps' | 'branches' | 'decode' | 'solve' | 'preview' | 'renewed',
  number
>;

/** One configuration's times: the first run after loading, and the median of the others for each stage. */
export interface Measured {
  readonly backend: string;
  readonly threads: number;
  /** Why it computes there. */
  readonly reason: string;
  /** Fetching, opening and warming up the graphs. */
  readonly load: number;
  readonly first: Seconds;
  readonly seconds: Seconds;
}

async function timed<T>(work: () => T | Promise<T>): Promise<[T, number]> {
  const start = performance.now();
  const result = await work();
  return [result, (performance.now() - start) / 1000];
}

/** Weights of both layers; fine alone needs nothing sampled. */
function guidanceOf({ latent: { streams, layers } }: Manifest, coarse: number, fine: number): Float32Array {
  return Float32Array.from(streams.flatMap(() => layers.map((_, layer) => (layer === 0 ? coarse : fine))));
}

function median(values: readonly number[]): number {
  return [...values].sort((a, b) => a - b)[values.length >> 1] ?? NaN;
}

/** Seconds until the part in view is there and until the whole is, and of which decoding and solving the whole. */
async function followed(
  generator: Generator,
  request: GenerateRequest,
): Promise<Pick<Seconds, 'preview' | 'renewed' | 'decode' | 'solve'>> {
  const start = performance.now();
  const since = (): number => (performance.now() - start) / 1000;
  let preview = NaN;
  const { seconds } = await generator.generate(request, {
    playhead: { frame: request.leader.frames / 2, at: secondsNow(), rate: 0 },
    onPreview: () => {
      preview = since();
    },
  });
  return { preview, renewed: since(), decode: seconds.decode, solve: seconds.solve };
}

export async function measure(preference: Preference, threads: number, repeats: number): Promise<Measured> {
  const scene = readNpz(new Uint8Array(await (await fetch('scene/scene.npz')).arrayBuffer()));
  const array = (name: string): Float32Array => Float32Array.from(scene.get(name)?.data ?? []);
  const leader = array('leader');
  const frames = leader.length / 66;
  const [generator, load] = await timed(() =>
    createGenerator({ manifestUrl: 'model/manifest.json', backend: preference, threads }),
  );
  const { manifest, backend } = generator;
  const recipe = readRecipe(manifest.audio);
  const song = array('song');
  const runs: Seconds[] = [];
  for (let run = 0; run <= repeats; run++) {
    const [music, features] = await timed(() => musicFeatures(song, recipe));
    // Another leader each time: the memory of the last one would be used again.
    const positions = leader.map((value) => value * (1 + run / 1000));
    // As the page reads a leader, before anything is measured.
    const clip = { fps: manifest.fps, frames, positions };
    const fitted = solve(clip);
    const weights = { guidance: unitGains(manifest.latent).fill(0), musicGuidance: 0, variety: 1 };
    const request: GenerateRequest = {
      leader: clip,
      fitted,
      music,
      ...weights,
      seed: 1,
    };
    const { seconds: sampled } = await generator.generate(request);
    const change = await followed(generator, { ...request, guidance: guidanceOf(manifest, 0, 0.5) });
    const all = { ...request, guidance: guidanceOf(manifest, 0.25, 0), musicGuidance: 1 };
    const { seconds: others } = await generator.generate(all);
    runs.push({ features, ...sampled, branches: sampled.steps + others.steps, ...change });
  }
  generator.dispose();
  const [first, ...rest] = runs;
  if (first === undefined) throw new Error('nothing was measured');
  const seconds = { ...first };
  for (const stage of Object.keys(first) as (keyof Seconds)[])
    seconds[stage] = median(rest.map((run) => run[stage]));
  return { backend: backend.name, threads: backend.threads, reason: backend.reason, load, first, seconds };
}

Object.assign(globalThis, { measure });
