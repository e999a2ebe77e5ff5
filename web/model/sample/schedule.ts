import type { Manifest } from '../manifest';

/** One sampling step: x becomes a x + b x0, with x0 predicted at `time`. */
export interface ScheduleStep {
  /** Timestep divided by the number of train steps, in [0, 1). */
  readonly time: number;
  readonly a: number;
  readonly b: number;
}

/**
 * DDIM (Song et al. 2021, Eq. 12 with sigma 0): the manifest's steps, evenly spaced from the last train step to its last
 * time; none is skipped, and the last one lands on the clean latents.
 */
export function ddim({
  train_steps: trainSteps,
  alphas_cumprod: alphas,
  last_time: lastTime,
  steps,
}: Manifest['diffusion']): ScheduleStep[] {
  const way = trainSteps - Math.round(lastTime * trainSteps);
  const timestep = (k: number): number => trainSteps - 1 - Math.floor((way * k) / Math.max(steps - 1, 1));
  const alpha = (k: number): number => (k < steps ? (alphas[timestep(k)] ?? NaN) : 1);
  return Array.from({ length: steps }, (_, k) => {
    const now = alpha(k);
    const next = alpha(k + 1);
    const a = Math.sqrt((1 - next) / (1 - now));
    return { time: timestep(k) / trainSteps, a, b: Math.sqrt(next) - a * Math.sqrt(now) };
  });
}
