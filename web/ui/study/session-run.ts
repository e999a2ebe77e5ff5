import type { Player } from '../../audio/client';
import { AppError } from '../../common/error';
import { criteriaFor, type Criterion } from './answers';
import { PairPlayer, type ShownPair, type StudyStage } from './pair-player';
import { PairView } from './pair-view';
import type { Pair } from './plan';
import { answersTo, firstOpen, type SavedSession, type Session, withAnswer } from './session';
import type { StudySet } from './set';

/** What a session needs of the page. */
export interface SessionServices {
  readonly stage: StudyStage | null;
  readonly player: Player;
  readonly storage: SavedSession;
  /** Milliseconds. */
  readonly now: () => number;
}

interface SessionEvents {
  readonly onProblem: (error: unknown) => void;
  readonly onRetry: () => void;
  readonly onEnd: (session: Session) => void;
}

/** Goes through the pairs of a session: makes their dances ready, plays them and keeps the answers. */
export class SessionRun {
  readonly #view: PairView;
  readonly #player: PairPlayer;
  #set: StudySet | null = null;
  #session: Session | null = null;
  #number = 0;
  /** When each pair was shown first since the session was opened, by its number, milliseconds. */
  readonly #shownFirst = new Map<number, number>();
  /** The pair whose dances are on the stage or are awaited. */
  #shown: Pair | null = null;
  #isWaiting = false;
  /** The visitor was told that the sound could not be started. */
  #isSoundMissing = false;

  constructor(
    private readonly services: SessionServices,
    private readonly events: SessionEvents,
  ) {
    this.#view = new PairView({
      togglePlay: () => void this.#togglePlay(),
      seek: (seconds) => {
        this.#player.seek(seconds);
      },
      answer: (criterion, score) => {
        this.#answer(criterion, score);
      },
      back: () => {
        this.#go(this.#number - 1);
      },
      next: () => {
        this.#go(this.#number + 1);
      },
      retry: () => {
        this.events.onRetry();
        this.#go(this.#number);
      },
    });
    this.#player = new PairPlayer(services.stage, services.player, (seconds, duration) => {
      this.#view.showTime(seconds, duration, services.player.playing);
    });
    services.player.onFailure = (error) => {
      this.#failSound(error);
    };
  }

  get element(): HTMLElement {
    return this.#view.element;
  }

  /** A key that was pressed anywhere on the page; true where it meant something. */
  handleKey(event: KeyboardEvent): boolean {
    return this.#session !== null && this.#view.handleKey(event);
  }

  /** Begins with the first pair that is not answered. */
  start(session: Session, set: StudySet | null): void {
    this.#set = set;
    this.#session = session;
    this.#shownFirst.clear();
    this.#keep();
    this.#go(firstOpen(session, (pair) => this.#criteria(pair).length));
  }

  /** Says what is being loaded, where a pair waits for it. */
  showStatus(text: string): void {
    if (this.#isWaiting) this.#showPair(text, false);
  }

  #keep(): void {
    if (this.#session && !this.services.storage.write(this.#session))
      this.events.onProblem(
        new AppError(
          'storage-refused',
          'This browser keeps no answers between visits.',
          'Do not close or reload the page before they are saved at the end.',
        ),
      );
  }

  #criteria({ duet }: Pair): ReturnType<typeof criteriaFor> {
    return criteriaFor(this.#set?.duets.find(({ name }) => name === duet)?.song !== null);
  }

  #showPair(waiting: string | null, isNew: boolean, failed = false): void {
    const session = this.#session!;
    const pair = session.pairs[this.#number]!;
    this.#view.show(
      {
        number: this.#number,
        pairs: session.pairs.length,
        criteria: this.#criteria(pair),
        answers: answersTo(session, this.#number),
        waiting,
        failed,
      },
      isNew,
    );
  }

  #go(number: number): void {
    const session = this.#session!;
    this.#number = number;
    this.#player.pause();
    if (number >= session.pairs.length) this.#finish(session);
    else void this.#present(session.pairs[number]!);
  }

  /** Shows a pair, and makes the dances of the next one ready meanwhile. */
  async #present(pair: Pair): Promise<void> {
    this.#shown = pair;
    this.#isWaiting = true;
    this.#showPair('Making the dances ready', true);
    try {
      const dances = await this.#dances(pair);
      if (this.#shown !== pair) return;
      this.#isWaiting = false;
      if (!this.#shownFirst.has(this.#number)) this.#shownFirst.set(this.#number, this.services.now());
      this.#showPair(null, false);
      this.#player.show(dances);
      // A browser that wants a click before any sound gets it from the Play button.
      await this.#play().catch((error: unknown) => {
        if (!(error instanceof AppError && error.code === 'playback-refused')) throw error;
      });
      const next = this.#session?.pairs[this.#number + 1];
      if (next) await this.#dances(next).catch(() => undefined);
    } catch (error) {
      if (this.#shown !== pair) return;
      this.#isWaiting = false;
      this.#showPair(null, false, true);
      this.events.onProblem(error);
    }
  }

  async #dances({ duet: name, left, right }: Pair): Promise<ShownPair> {
    const duet = this.#set!.duets.find((one) => one.name === name)!;
    // One after the other: the model makes one dance at a time.
    const [leader, a] = [await duet.leader(), await duet.partner(left)];
    return { leader, left: a, right: await duet.partner(right), song: duet.song };
  }

  /** @throws {AppError} `playback-refused` */
  async #play(): Promise<void> {
    await this.#player.play();
    if (this.#isSoundMissing && this.#player.playing) {
      this.#isSoundMissing = false;
      this.events.onRetry();
    }
  }

  async #togglePlay(): Promise<void> {
    if (this.#player.playing) {
      this.#player.pause();
      this.#player.seek(this.services.player.time);
      return;
    }
    await this.#play().catch((error: unknown) => {
      this.#failSound(error);
    });
  }

  /** Playback has stopped: the picture stands, and the button offers to play. */
  #failSound(error: unknown): void {
    this.#player.pause();
    this.#player.seek(this.services.player.time);
    this.#isSoundMissing = true;
    this.events.onProblem(error);
  }

  #answer(criterion: Criterion, score: number): void {
    const now = this.services.now();
    const seconds = (now - (this.#shownFirst.get(this.#number) ?? now)) / 1000;
    this.#session = withAnswer(this.#session!, this.#number, criterion, score, seconds);
    this.#keep();
    this.#showPair(null, false);
  }

  #finish(answered: Session): void {
    const session = { ...answered, finished: true };
    // It has been said before where nothing can be kept.
    this.services.storage.write(session);
    this.#session = null;
    this.#shown = null;
    this.events.onEnd(session);
  }
}
