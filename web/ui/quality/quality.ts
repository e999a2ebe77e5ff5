import type { Duet, QualityRequest, Report } from '../../quality/client';
import { isAbort } from '../store/problems';
import { reactorMotion } from '../store/reactor-motion';
import { musicBeats } from '../store/song-shift';
import type { AppState } from '../store/state';
import { qualityMeasured } from '../store/actions/reaction';
import { apply, type Store, watchAll } from '../store/store';
import { noticeAdded } from '../store/actions/notices';

/** What the measures depend on; compared by identity. */
function measuredParts(state: AppState): readonly unknown[] {
  return [reactorMotion(state), state.leader, state.song, state.shift, state.manifest];
}

/** The duet on the stage, with the generated dancer as the reactor; null while there is none. */
function duetOf(state: AppState): Duet | null {
  const { leader, manifest } = state;
  const reactor = reactorMotion(state);
  if (!leader || !reactor || !manifest) return null;
  const { fps } = reactor;
  return {
    fps,
    frames: Math.min(leader.motion.frames, reactor.frames),
    leader: leader.motion.positions,
    reactor: reactor.positions,
    beats: musicBeats(state).map((beat) => Math.round(beat * fps)),
    block: manifest.latent.block * manifest.latent.stride,
  };
}

/**
 * Measures the dance on the stage whenever it changes; a newer dance aborts the measurement of an older one, whose
 * numbers stay until the new ones are there.
 * @param measure resolves with the report; rejects at once when the signal is aborted
 * @returns a function that stops it
 */
export function createQuality(
  store: Store,
  measure: (question: QualityRequest, signal: AbortSignal) => Promise<Report>,
): () => void {
  let running = new AbortController();

  const begin = async (): Promise<void> => {
    running.abort();
    running = new AbortController();
    const { signal } = running;
    const state = store.getState();
    const reactor = reactorMotion(state);
    const duet = duetOf(state);
    if (!duet || !reactor || !state.manifest) {
      if (state.quality && !reactor) apply(store, qualityMeasured(null));
      return;
    }
    try {
      const report = await measure({ duet, rules: state.manifest.quality }, signal);
      if (!signal.aborted) apply(store, qualityMeasured({ reactor, report }));
    } catch (error) {
      if (signal.aborted || isAbort(error)) return;
      apply(store, qualityMeasured(null));
      apply(
        store,
        noticeAdded('The quality of the dance could not be measured. Everything else works as before.'),
      );
    }
  };

  const stop = watchAll(store, measuredParts, () => void begin());
  return () => {
    stop();
    running.abort();
  };
}
