import type { Player } from '../../audio/client';
import { isAbort, playbackProblem } from '../store/problems';
import { danceDuration } from '../store/selectors';
import { songStart } from '../store/song-shift';
import type { AppState } from '../store/state';
import { firstVisitEnded } from '../store/actions/files';
import { apply, type Store, watch, watchAll } from '../store/store';
import { problemShown } from '../store/actions/notices';
import { regionSet } from '../store/actions/timeline';
import { playbackSet } from '../store/actions/view';
import { combineDisposers } from '../widgets/dom';
import type { Span } from '../store/time-scale';

/** How much is played in a loop around a moment, and how much of that before it, seconds. */
const MOMENT_SECONDS = 2;
const LEAD_IN = 0.5;

/** Connects player and store: the audio is the clock, and the store takes its time once per drawn frame. */
export class PlaybackControl {
  readonly #store: Store;
  readonly #player: Player;
  readonly #unsubscribe: () => void;
  #frame = 0;

  constructor(store: Store, player: Player) {
    this.#store = store;
    this.#player = player;
    player.onFailure = (error) => {
      this.#stop(error);
    };
    this.#unsubscribe = combineDisposers(
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
          this.#setLoop(state);
        },
      ),
      watch(
        store,
        (state) => state.playback.playing,
        (playing) => {
          this.#setPlaying(playing);
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
  }

  readonly toggle = (): void => {
    if (this.#store.getState().playback.playing) apply(this.#store, playbackSet({ playing: false }));
    else this.#start();
  };

  readonly seek = (seconds: number): void => {
    const time = Math.min(danceDuration(this.#store.getState()), Math.max(0, seconds));
    this.#player.seek(time);
    apply(this.#store, playbackSet({ time }));
  };

  /** Plays the seconds around a moment in a loop. */
  readonly loopAround = (seconds: number): void => {
    const from = Math.max(0, seconds - LEAD_IN);
    const to = Math.min(danceDuration(this.#store.getState()), from + MOMENT_SECONDS);
    apply(this.#store, regionSet({ from, to }));
    this.seek(from);
    this.#start();
  };

  readonly playFromStart = (): void => {
    this.seek(0);
    this.#start();
  };

  readonly dispose = (): void => {
    cancelAnimationFrame(this.#frame);
    this.#unsubscribe();
  };

  /** Plays on from the playhead, or from the start of what is played when the playhead is at its end. */
  #start(): void {
    const state = this.#store.getState();
    const duration = danceDuration(state);
    if (duration === 0) return;
    const part = loopedPart(state) ?? { from: 0, to: duration };
    if (state.playback.time >= part.to - 1e-3) this.seek(part.from);
    apply(this.#store, firstVisitEnded());
    apply(this.#store, playbackSet({ playing: true }));
  }

  #setPlaying(playing: boolean): void {
    cancelAnimationFrame(this.#frame);
    if (!playing) {
      this.#player.pause();
      return;
    }
    this.#player.play().then(
      () => {
        if (this.#store.getState().playback.playing) this.#requestFrame();
      },
      (error: unknown) => {
        this.#stop(error);
      },
    );
  }

  #stop(error: unknown): void {
    apply(this.#store, playbackSet({ playing: false }));
    if (!isAbort(error)) apply(this.#store, problemShown(playbackProblem(error)));
  }

  #setLoop(state: AppState): void {
    const part = loopedPart(state);
    this.#player.setLoop(part);
    // A region that was drawn before the playhead is played at once.
    if (part && state.playback.playing && state.playback.time > part.to) this.seek(part.from);
  }

  #requestFrame(): void {
    // Where it was stopped and started again before the player began, both starts come here.
    cancelAnimationFrame(this.#frame);
    this.#frame = requestAnimationFrame(() => {
      this.#followPlayer();
    });
  }

  /** Takes the player's time, and stops at the end of the dance. */
  #followPlayer(): void {
    const duration = danceDuration(this.#store.getState());
    const { time } = this.#player;
    if (time >= duration && !this.#store.getState().playback.loop) {
      apply(this.#store, playbackSet({ playing: false, time: duration }));
      return;
    }
    apply(this.#store, playbackSet({ time }));
    this.#requestFrame();
  }
}

/** The part that is looped, seconds: the region, or all of the dance; null without a loop. */
function loopedPart(state: AppState): Span | null {
  const { loop, region } = state.playback;
  return loop ? (region ?? { from: 0, to: danceDuration(state) }) : null;
}
