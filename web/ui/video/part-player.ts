import type { LoadedLeader } from '../store/reaction';
import { partReadSet } from '../store/actions/files';
import { apply, type Store } from '../store/store';

const reducedMotion = matchMedia('(prefers-reduced-motion: reduce)');

/**
 * Plays on the stage, once and without sound, what has been read of a video, and rests at its last moment. Where moving
 * pictures are not wanted only that is shown.
 */
export class PartPlayer {
  #frame = 0;

  constructor(private readonly store: Store) {}

  /** Plays this part from its start, in the place of the one before. */
  play(leader: LoadedLeader): void {
    cancelAnimationFrame(this.#frame);
    const { frames, fps } = leader.motion;
    const last = (frames - 1) / fps;
    const begun = performance.now() - (reducedMotion.matches ? 1000 * last : 0);
    const step = (now: number): void => {
      const time = Math.min(last, Math.max(0, now - begun) / 1000);
      apply(this.store, partReadSet({ leader, time }));
      if (time < last) this.#frame = requestAnimationFrame(step);
    };
    step(performance.now());
  }

  /** The stage shows the page's dance again. */
  end(): void {
    cancelAnimationFrame(this.#frame);
    if (this.store.getState().partRead) apply(this.store, partReadSet(null));
  }
}
