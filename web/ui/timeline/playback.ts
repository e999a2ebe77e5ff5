import type { Player } from '../../audio/client';
import { isAbort, playbackProblem } from '../store/problems';
import { danceDuration } from '../store/selectors';
import { songStart } from '../store/song-shift';
import type { AppState } from '../store/state';
import { firstVisitEnded } from '../store/actions/files';
import { apply, type Store, watch, watchAll } from '../store/store';
import { problemShown } from '../store/actions/notices';
import { playbackSet } from '../store/actions/view';
import { together } from '../widgets/dom';
import type { Span } from '../store/time-scale';

export interface PlaybackControl {
  readonly toggle: () => void;
  readonly seek: (seconds: number) => void;
  readonly playFromStart: () => void;
  readonly dispose: () => void;
}

/** Ties player and store together: the audio is the clock, the store follows it once per drawn frame. */
export function createPlayback(store: Store, player: Player): PlaybackControl {
  let frame = 0;

  const seek = (seconds: number): void => {
    const to = Math.min(danceDuration(store.getState()), Math.max(0, seconds));
    player.seek(to);
    apply(store, playbackSet({ time: to }));
  };
  const follow = (): void => {
    const whole = danceDuration(store.getState());
    if (player.time >= whole && !store.getState().playback.loop) {
      apply(store, playbackSet({ playing: false, time: whole }));
      return;
    }
    apply(store, playbackSet({ time: player.time }));
    frame = requestAnimationFrame(follow);
  };
  const start = (): void => {
    const state = store.getState();
    if (danceDuration(state) === 0) return;
    const part = loopOf(state) ?? { from: 0, to: danceDuration(state) };
    if (state.playback.time >= part.to - 1e-3) seek(part.from);
    apply(store, firstVisitEnded());
    apply(store, playbackSet({ playing: true }));
  };

  const disposers = together(
    watchAll(
      store,
      (state) => [state.song, state.leader],
      (state) => {
        player.load(state.song?.data.sound ?? null, danceDuration(state));
        player.seek(state.playback.time);
      },
    ),
    watch(store, songStart, (seconds) => {
      player.setSongStart(seconds);
    }),
    watchAll(
      store,
      (state) => [state.playback.loop, state.playback.region, state.song, state.leader],
      (state) => {
        const part = loopOf(state);
        player.setLoop(part);
        // A region drawn behind the playhead is meant to be heard now.
        if (part && state.playback.playing && state.playback.time > part.to) seek(part.from);
      },
    ),
    watch(
      store,
      (state) => state.playback.playing,
      (playing) => {
        cancelAnimationFrame(frame);
        if (!playing) {
          player.pause();
          return;
        }
        player.play().then(
          () => {
            if (store.getState().playback.playing) frame = requestAnimationFrame(follow);
          },
          (error: unknown) => {
            apply(store, playbackSet({ playing: false }));
            if (!isAbort(error)) apply(store, problemShown(playbackProblem(error)));
          },
        );
      },
    ),
    watch(
      store,
      (state) => state.playback.speed,
      (speed) => {
        player.setSpeed(speed);
      },
    ),
  );
  return {
    toggle: () => {
      if (store.getState().playback.playing) apply(store, playbackSet({ playing: false }));
      else start();
    },
    seek,
    playFromStart: () => {
      seek(0);
      start();
    },
    dispose: () => {
      cancelAnimationFrame(frame);
      disposers();
    },
  };
}

/** What is gone round in: the region, or all of the dance; null without a loop. */
function loopOf(state: AppState): Span | null {
  const { loop, region } = state.playback;
  return loop ? (region ?? { from: 0, to: danceDuration(state) }) : null;
}
