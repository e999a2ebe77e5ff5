import { AppError } from '../../common/error';
import type { Player } from '../../audio/client';
import type { LeaderRequest } from '../../motion/client';
import type { SolvedMotion } from '../../motion/skeleton/clip';
import { el } from '../widgets/dom';
import { type Answer, criteriaFor, type Criterion } from './answers';
import { answersCsv, readAnswers, summaryCsv } from './csv';
import { setOfFiles } from './file-set';
import { PairPlayer, type ShownPair, type StudyStage } from './pair-player';
import { PairView } from './pair-view';
import { makePlan, type Pair } from './plan';
import { resultView } from './result-view';
import { answersTo, firstOpen, type Session, type KeptSession, withAnswer } from './session';
import { contentOf, OURS, type StudySet } from './set';
import { SetupView } from './setup-view';
import { summarise } from './summary';

/** What the study needs of the page. */
export interface StudyServices {
  readonly stage: StudyStage | null;
  readonly player: Player;
  readonly readLeader: (request: LeaderRequest) => Promise<{ readonly motion: SolvedMotion }>;
  /** The set that needs no files; `onStatus` is told what is being loaded. */
  readonly builtIn: (onStatus: (text: string) => void) => Promise<StudySet>;
  readonly storage: KeptSession;
  readonly saveFile: (file: Blob, name: string) => void;
  /** A new seed. */
  readonly seed: () => number;
  /** Milliseconds. */
  readonly now: () => number;
}

/** The blind test: setup, then one pair after the other, then the result. */
export class Study {
  readonly element = el('div', { class: 'study-panel' });
  readonly #alert = el('div', { class: 'study-problem', attributes: { role: 'alert' } });
  readonly #setup: SetupView;
  readonly #pairView: PairView;
  readonly #player: PairPlayer;
  #set: StudySet | null = null;
  #session: Session | null = null;
  #number = 0;
  /** When the present pair was shown first, milliseconds. */
  #since = 0;
  /** The pair whose dances are on the stage or are awaited. */
  #shown: Pair | null = null;
  #isWaiting = false;

  constructor(private readonly services: StudyServices) {
    this.#setup = new SetupView({
      chooseFiles: (files) =>
        void this.#load((onStatus) =>
          setOfFiles(files, services.readLeader, (share) => {
            onStatus(`Reading the files, ${Math.round(100 * share)} %`);
          }),
        ),
      useBuiltIn: () => void this.#load(services.builtIn),
      start: (choice) => {
        this.#begin(choice);
      },
      resume: () => {
        const kept = services.storage.read();
        if (kept) this.#run(kept);
      },
      addAnswers: (files) => void this.#addUp(files),
    });
    this.#pairView = new PairView({
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
    });
    this.#player = new PairPlayer(services.stage, services.player, (seconds, duration) => {
      this.#pairView.showTime(seconds, duration, services.player.playing);
    });
    this.#alert.hidden = true;
    this.#showSetup();
  }

  /** A key that was pressed anywhere on the page; true where it meant something. */
  readonly handleKey = (event: KeyboardEvent): boolean =>
    this.#session !== null && this.#pairView.handleKey(event);

  #show(element: HTMLElement): void {
    this.element.replaceChildren(this.#alert, element);
  }

  #fail(error: unknown): void {
    const [title, hint] =
      error instanceof AppError
        ? [error.message, error.hint]
        : ['This did not work.', 'Try again; the answers so far are kept.'];
    if (!(error instanceof AppError)) console.error(error);
    this.#alert.replaceChildren(el('b', { text: title }), el('p', { text: hint }));
    this.#alert.hidden = false;
  }

  #showSetup(waiting: string | null = null): void {
    this.#session = null;
    this.#setup.show(this.#set, waiting, this.services.storage.read());
    if (!this.#setup.element.isConnected) this.#show(this.#setup.element);
  }

  /** Says what is being read or loaded, which goes on while the first pairs are made ready. */
  #showStatus(text: string): void {
    if (!this.#session) this.#showSetup(text);
    else if (this.#isWaiting) this.#showPair(text, false);
  }

  async #load(load: (onStatus: (text: string) => void) => Promise<StudySet>): Promise<void> {
    this.#alert.hidden = true;
    this.#showSetup('Reading the dances');
    try {
      this.#set = await load((text) => {
        this.#showStatus(text);
      });
    } catch (error) {
      this.#fail(error);
    }
    this.#showSetup();
  }

  #begin({ participant, pairs, seed }: { participant: string; pairs: number; seed: number | null }): void {
    const set = this.#set;
    if (!set) return;
    const drawn = seed ?? this.services.seed();
    this.#run({
      participant,
      set: set.name,
      content: contentOf(set),
      seed: drawn,
      pairs: makePlan(set.duets, set.reference, pairs, drawn),
      answers: [],
    });
  }

  #run(session: Session): void {
    this.#alert.hidden = true;
    this.#session = session;
    this.#keep();
    this.#show(this.#pairView.element);
    this.#go(firstOpen(session, (pair) => this.#criteria(pair).length));
  }

  #keep(): void {
    if (this.#session && !this.services.storage.write(this.#session))
      this.#fail(
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

  #showPair(waiting: string | null, isNew: boolean): void {
    const session = this.#session!;
    const pair = session.pairs[this.#number]!;
    this.#pairView.show(
      {
        number: this.#number,
        pairs: session.pairs.length,
        criteria: this.#criteria(pair),
        answers: answersTo(session, this.#number),
        waiting,
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
      this.#since = this.services.now();
      this.#showPair(null, false);
      this.#player.show(dances);
      await this.#play();
      const next = this.#session?.pairs[this.#number + 1];
      if (next) await this.#dances(next).catch(() => undefined);
    } catch (error) {
      if (this.#shown === pair) this.#fail(error);
    }
  }

  async #dances({ duet: name, left, right }: Pair): Promise<ShownPair> {
    const duet = this.#set!.duets.find((one) => one.name === name)!;
    // One after the other: the model makes one dance at a time.
    const [leader, a] = [await duet.leader(), await duet.partner(left)];
    return { leader, left: a, right: await duet.partner(right), song: duet.song };
  }

  async #play(): Promise<void> {
    // A browser that wants a click before any sound gets it from the Play button.
    await this.#player.play().catch((error: unknown) => {
      if (!(error instanceof AppError && error.code === 'playback-refused')) throw error;
    });
  }

  async #togglePlay(): Promise<void> {
    if (!this.#player.playing) return this.#play();
    this.#player.pause();
    this.#player.seek(this.services.player.time);
  }

  #answer(criterion: Criterion, score: number): void {
    const seconds = (this.services.now() - this.#since) / 1000;
    this.#session = withAnswer(this.#session!, this.#number, criterion, score, seconds);
    this.#keep();
    this.#showPair(null, false);
  }

  #finish(session: Session): void {
    this.#session = null;
    this.#shown = null;
    this.#showResult(session.answers, session.content, this.#set?.reference ?? null, session.participant);
  }

  #showResult(answers: readonly Answer[], content: string, reference: string | null, whose: string): void {
    const save = (text: string, what: string): void => {
      const name = `study-${what}-${whose.replace(/[^\p{L}\p{N}-]+/gu, '_')}.csv`;
      this.services.saveFile(new Blob([text], { type: 'text/csv' }), name);
    };
    const element = resultView(answers, reference, {
      saveAnswers: () => {
        save(answersCsv(answers), 'answers');
        // Only what is saved is no longer kept here.
        if (this.services.storage.read()?.content === content) this.services.storage.forget();
      },
      saveSummary: () => {
        save(summaryCsv(summarise(answers, reference)), 'summary');
      },
      again: () => {
        this.#showSetup();
      },
    });
    this.#show(element);
    element.querySelector('h1')?.focus();
  }

  /** Shows the summary of answers that were saved before. */
  async #addUp(files: readonly File[]): Promise<void> {
    this.#alert.hidden = true;
    try {
      const all = await Promise.all(files.map(async (file) => readAnswers(await file.text())));
      const answers = all.flat();
      const methods = answers.flatMap(({ left, right }) => [left, right]);
      this.#showResult(answers, '', methods.includes(OURS) ? OURS : null, 'all');
    } catch (error) {
      this.#fail(error);
    }
  }
}
