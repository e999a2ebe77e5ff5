import type { Manifest } from '../manifest';

/** One sampling step as the step graph takes it. */
export interface ScheduleStep {
  /** Timestep divided by the number of train steps, in [0, 1). */
  readonly time: number;
  /** a and b of x_next = a x + b x0. */
  readonly coefficients: readonly [number, number];
}

/**
 * DDIM (Song et al. 2021, Eq. 12 with sigma 0) in `steps` equal strides from the last train step; none is skipped,
 * and the last one lands on the clean latents.
 */
export function ddim(diffusion: Manifest['diffusion'], steps: number): ScheduleStep[] {
  const { train_steps: trainSteps, alphas_cumprod: alphas } = diffusion;
  const timestep = (k: number): number => Math.floor(((steps - k) * trainSteps) / steps) - 1;
  const alpha = (k: number): number => (k < steps ? (alphas[timestep(k)] ?? NaN) : 1);
  return Array.from({ length: steps }, (_, k) => {
    const now = alpha(k);
    const next = alpha(k + 1);
    const a = Math.sqrt((1 - next) / (1 - now));
    const b = Math.sqrt(next) - a * Math.sqrt(now);
    return { time: timestep(k) / trainSteps, coefficients: [a, b] };
  });
}
