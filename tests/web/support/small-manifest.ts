import { parseManifest } from '../../../web/model/parse-manifest';
import { FLOOR } from '../../../web/motion/retarget/axes-and-units';
import { PARENTS, SMPL22 } from '../../../web/motion/skeleton/skeleton';
import { type Manifest } from '../../../web/model/manifest';

const file = (path: string) => ({ path, bytes: 3, sha256: '0'.repeat(64) });
type Shapes = Record<string, (string | number)[]>;
const graph = (path: string, inputs: Shapes, outputs: Shapes) => ({
  inputs,
  outputs,
  files: { wasm: file(path), webgpu: file(path) },
});

/** Bones of 0.1 m that point upwards. */
const smallBody = (): number[][] => SMPL22.map((_, joint) => [0, joint === 0 ? 0 : 0.1, 0]);

/** A manifest with small round numbers, as parsed JSON: blocks of 6 latent frames, 3 channels, memory width 2. */
export function smallJson() {
  return {
    format: 'reactdance-model',
    version: 10,
    id: 'small',
    name: 'Small',
    created: '2026-01-01',
    licence: { weights: 'MIT', data: 'none' },
    attribution: 'nobody',
    notes: [] as string[],
    skeleton: {
      joints: [...SMPL22] as string[],
      parents: [...PARENTS],
      upper: [3],
      lower: [1],
      feet: [7],
      reference_height: 1.5,
      reactor_height: 1.4,
      bodies: { reactor: smallBody(), leader: smallBody() },
      training_bodies: { reactor: smallBody(), leader: smallBody() },
      floor: { ...FLOOR } as { toe_rest: number; percentile: number },
    },
    fps: 30,
    leader: { unfamiliar_from: 1.2 },
    latent: {
      stride: 4,
      block: 6,
      channels: 3,
      streams: ['upper', 'lower', 'placement'],
      layers: ['coarse', 'fine'],
      memory_width: 2,
      receptive_field: { condition: 2, decode: 2 },
    },
    diffusion: {
      train_steps: 1000,
      alphas_cumprod: Array.from({ length: 1000 }, (_, t) => Math.cos(((t + 1) / 1001) * (Math.PI / 2)) ** 2),
      prediction: 'x0',
      clamp: 'quantiser range',
      sampler: 'ddim',
      last_time: 0.25,
      steps: 10,
    },
    guidance: {
      convention: {} as Record<string, string>,
      coarse: { min: -1, max: 1, step: 0.05, default: 0 },
      fine: { min: -1, max: 1, step: 0.05, default: 0 },
      music: { min: 0, max: 4, step: 0.25, default: 2 },
      variety: { min: 0, max: 2, step: 0.05, default: 1, seeds: 4 },
    },
    noise: { algorithm: 'philox4x32-10' },
    decode: { foot_contact: 0 },
    architecture: {},
    audio: {
      sample_rate: 15360,
      cancelled_share: 0.01,
      hop: 512,
      n_fft: 2048,
      mels: 128,
      mel_fmin: 0,
      mel_fmax: 7680,
      amin: 1e-10,
      top_db: 80,
      mfcc: 1,
      delta_width: 3,
      hpss_kernel: 31,
      hpss_power: 2,
      chroma: 1,
      chroma_tuning: 0,
      chroma_octave: 5,
      chroma_octave_width: 2,
      onset_lag: 1,
      start_bpm: 120,
      tempo_std: 1,
      tempo_window: 8,
      max_tempo: 320,
      tightness: 100,
      features: 5,
    },
    quality: {
      contact: { percentile: 5, height: 0.03, vertical_speed: 0.1, slide_speed: 0.2 },
      penetration: {
        capsules: [{ from: 'pelvis', to: 'spine1', radius: 0.1, beyond: 0 }],
        reference_height: 1.4,
        deep: 0.01,
      },
      beats: { smoothing: 5, tolerance: 3 },
      seams: { radius: 2, clear: 8 },
      glide: { ratio: 1.5, reach: 0.5, free_speed: 1.5 },
    },
    graphs: {
      condition: graph(
        'condition.onnx',
        { leader: ['frames', 22, 3], music: ['frames', 5], music_valid: ['frames'], role: [1] },
        { memory: ['latents', 2], unfamiliarity: ['latents'] },
      ),
      step: graph(
        'step.onnx',
        {
          x: ['blocks', 6, 2, 3],
          memory: ['blocks', 6, 2],
          valid: ['blocks', 6],
          keep: [1],
          time: [1],
          a: [1],
          b: [1],
        },
        { next: ['blocks', 6, 2, 3] },
      ),
      decode: graph(
        'decode.onnx',
        { latents: ['latents', 2, 3], leader: ['frames', 22, 3], gains: [3, 2], role: [1] },
        { reactor: ['frames', 22, 3] },
      ),
    },
    golden: file('golden.npz'),
  };
}

export const small: Manifest = parseManifest(smallJson());

/** The same of a model of the same name whose step graph alone was trained again. */
export function retrained(): Manifest {
  const { step } = small.graphs;
  const wasm = { ...step.files.wasm, sha256: '1'.repeat(64) };
  return { ...small, graphs: { ...small.graphs, step: { ...step, files: { ...step.files, wasm } } } };
}
