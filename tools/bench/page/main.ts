/** The browser half of the bench: the app's own modules, timed on the scene that the Python half made. */
import { musicFeatures } from '../../../web/audio/features';
import { readRecipe } from '../../../web/audio/recipe';
import { createGenerator } from '../../../web/model/client';
import { readNpz } from '../../../web/model/load/npz';

export type Seconds = Record<'features' | 'condition' | 'steps' | 'decode' | 'solve', number>;

/** One configuration's times: the first run after loading, and the fastest run of each stage. */
export interface Measured {
  readonly backend: string;
  readonly threads: number;
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

export async function measure(threads: number, steps: number, repeats: number): Promise<Measured> {
  const scene = readNpz(new Uint8Array(await (await fetch('scene/scene.npz')).arrayBuffer()));
  const array = (name: string): Float32Array => Float32Array.from(scene.get(name)?.data ?? []);
  const leader = array('leader');
  const frames = leader.length / 66;
  const [generator, load] = await timed(() =>
    createGenerator({ manifestUrl: 'model/manifest.json', backend: 'wasm', threads }),
  );
  const { manifest, backend } = generator;
  const recipe = readRecipe(manifest.audio);
  const song = array('song');
  const runs: Seconds[] = [];
  for (let run = 0; run <= repeats; run++) {
    const [music, features] = await timed(() => musicFeatures(song, recipe));
    // Another leader each time: the memory of the last one would be used again.
    const positions = leader.map((value) => value * (1 + run / 1000));
    const { layers, streams } = manifest.latent;
    const guidance = new Float32Array(streams.length * layers.length).map(
      (_, i) => manifest.guidance.default[layers[i % layers.length] ?? ''] ?? 0,
    );
    const { seconds } = await generator.generate({
      leader: { fps: manifest.fps, frames, positions },
      music,
      guidance,
      musicGuidance: manifest.guidance.music.default,
      steps,
      seed: 1,
    });
    runs.push({ features, ...seconds });
  }
  generator.dispose();
  const [first, ...rest] = runs;
  if (first === undefined) throw new Error('nothing was measured');
  const seconds = { ...first };
  for (const run of rest) {
    for (const stage of Object.keys(run) as (keyof Seconds)[]) {
      seconds[stage] = Math.min(seconds[stage], run[stage]);
    }
  }
  return { backend: backend.name, threads: backend.threads, load, first, seconds };
}

Object.assign(globalThis, { measure });
