import type { Player } from '../../audio/client';
import type { SolvedMotion } from '../../motion/skeleton/clip';

/** The part of the stage that is needed. */
export interface StudyStage {
  readonly setDancers: (dancers: { leader: SolvedMotion; reactor: SolvedMotion }) => void;
  readonly setOther: (
    other: {
      readonly motion: SolvedMotion;
      readonly mode: 'right';
      readonly labels: { readonly left: string; readonly right: string };
    } | null,
  ) => void;
  readonly setTime: (seconds: number) => void;
}

/** Two couples beside each other, ready to be shown. */
export interface ShownPair {
  readonly leader: SolvedMotion;
  readonly left: SolvedMotion;
  readonly right: SolvedMotion;
  readonly song: Blob | null;
}

const LABELS = { left: 'A', right: 'B' };

/** Plays two couples side by side on one stage, in step with the song, again and again. */
export class PairPlayer {
  #frame = 0;
  #duration = 0;

  /** @param onTime is told seconds and duration at every picture */
  constructor(
    private readonly stage: StudyStage | null,
    private readonly player: Player,
    private readonly onTime: (seconds: number, duration: number) => void,
  ) {}

  get playing(): boolean {
    return this.player.playing;
  }

  /** Shows a pair from its beginning; dances of different lengths end with the shortest. */
  show({ leader, left, right, song }: ShownPair): void {
    this.pause();
    this.#duration = Math.min(...[leader, left, right].map(({ frames, fps }) => frames / fps));
    this.stage?.setDancers({ leader, reactor: left });
    this.stage?.setOther({ motion: right, mode: 'right', labels: LABELS });
    this.player.load(song, this.#duration);
    this.player.setLoop({ from: 0, to: this.#duration });
    this.seek(0);
  }

  /** @throws {AppError} `playback-refused` */
  async play(): Promise<void> {
    await this.player.play();
    // A pause or another pair may have come meanwhile.
    if (this.player.playing) this.#follow();
  }

  pause(): void {
    cancelAnimationFrame(this.#frame);
    this.player.pause();
  }

  seek(seconds: number): void {
    this.player.seek(seconds);
    this.#show();
  }

  #show(): void {
    const { time } = this.player;
    this.stage?.setTime(time);
    this.onTime(time, this.#duration);
  }

  #follow(): void {
    // One loop, also where play was asked for twice.
    cancelAnimationFrame(this.#frame);
    this.#frame = requestAnimationFrame(() => {
      this.#show();
      if (this.player.playing) this.#follow();
    });
  }
}
