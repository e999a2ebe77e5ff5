import { AppError } from '../../common/error';
import type { LeaderRequest } from '../../motion/client';
import type { SolvedMotion } from '../../motion/skeleton/clip';
import { el } from '../widgets/dom';
import { type Answer, withoutRepeats } from './answers';
import { answersCsv, readAnswers, summaryCsv } from './csv';
import { setOfFiles } from './file-set';
import { makePlan } from './plan';
import { resultView } from './result-view';
import type { Session } from './session';
import { SessionRun, type SessionServices } from './session-run';
import { contentOf, OURS, type StudySet } from './set';
import { SetupView } from './setup-view';
import { summarise } from './summary';

/** What the study needs of the page. */
export interface StudyServices extends SessionServices {
  readonly readLeader: (request: LeaderRequest) => Promise<{ readonly motion: SolvedMotion }>;
  /** The set that needs no files; `onStatus` is told what is being loaded. */
  readonly builtIn: (onStatus: (text: string) => void) => Promise<StudySet>;
  readonly saveFile: (file: Blob, name: string) => void;
  /** A new seed. */
  readonly seed: () => number;
}

/** The blind test: setup, then one pair after the other, then the result. */
export class Study {
  readonly element = el('div', { class: 'study-panel' });
  readonly #alert = el('div', { class: 'study-problem', attributes: { role: 'alert' } });
  readonly #setup: SetupView;
  readonly #run: SessionRun;
  #set: StudySet | null = null;
  /** How many sets were asked for: only the newest one is shown. */
  #asked = 0;

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
        if (kept) this.#open(kept);
      },
      save: (kept) => {
        this.#save(answersCsv(kept.answers), 'answers', kept.participant);
        this.services.storage.forget();
        this.#showSetup();
      },
      addAnswers: (files) => void this.#addUp(files),
    });
    this.#run = new SessionRun(services, {
      onProblem: (error) => {
        this.#fail(error);
      },
      onRetry: () => {
        this.#alert.hidden = true;
      },
      onEnd: ({ answers, content, participant }) => {
        this.#showResult(answers, content, this.#set?.reference ?? null, participant);
      },
    });
    this.#alert.hidden = true;
    this.#showSetup();
  }

  /** A key that was pressed anywhere on the page; true where it meant something. */
  readonly handleKey = (event: KeyboardEvent): boolean => this.#run.handleKey(event);

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

  get #isSettingUp(): boolean {
    return this.element.contains(this.#setup.element);
  }

  #showSetup(waiting: string | null = null): void {
    this.#setup.show(this.#set, waiting, this.services.storage.read());
    if (!this.#isSettingUp) this.#show(this.#setup.element);
  }

  /** Says what is being read or loaded, which goes on while the first pairs are made ready. */
  #showStatus(text: string): void {
    if (this.#isSettingUp) this.#showSetup(text);
    else this.#run.showStatus(text);
  }

  async #load(load: (onStatus: (text: string) => void) => Promise<StudySet>): Promise<void> {
    const number = ++this.#asked;
    /** No other set has been asked for since, and no test has begun with the one before. */
    const isAwaited = (): boolean => number === this.#asked && this.#isSettingUp;
    this.#alert.hidden = true;
    this.#showSetup('Reading the dances');
    try {
      const set = await load((text) => {
        if (number === this.#asked) this.#showStatus(text);
      });
      if (isAwaited()) this.#set = set;
    } catch (error) {
      if (isAwaited()) this.#fail(error);
    }
    if (isAwaited()) this.#showSetup();
  }

  #begin({ participant, pairs, seed }: { participant: string; pairs: number; seed: number | null }): void {
    const set = this.#set;
    if (!set) return;
    const drawn = seed ?? this.services.seed();
    const start = (): void => {
      this.#open({
        participant,
        set: set.name,
        content: contentOf(set),
        seed: drawn,
        pairs: makePlan(set.duets, set.reference, pairs, drawn),
        answers: [],
        finished: false,
      });
    };
    const kept = this.services.storage.read();
    if (kept && kept.answers.length > 0) this.#setup.askBeforeReplacing(kept, start);
    else start();
  }

  #open(session: Session): void {
    this.#alert.hidden = true;
    this.#show(this.#run.element);
    this.#run.start(session, this.#set);
  }

  #save(text: string, what: string, whose: string): void {
    const name = `study-${what}-${whose.replace(/[^\p{L}\p{N}-]+/gu, '_')}.csv`;
    this.services.saveFile(new Blob([text], { type: 'text/csv' }), name);
  }

  /** @param repeated answers that were left out because they are there already */
  #showResult(
    answers: readonly Answer[],
    content: string,
    reference: string | null,
    whose: string,
    repeated = 0,
  ): void {
    const element = resultView(answers, repeated, reference, {
      saveAnswers: () => {
        this.#save(answersCsv(answers), 'answers', whose);
        // Only what is saved is no longer kept here.
        if (this.services.storage.read()?.content === content) this.services.storage.forget();
      },
      saveSummary: () => {
        this.#save(summaryCsv(summarise(answers, reference)), 'summary', whose);
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
      const given = all.flat();
      const answers = withoutRepeats(given);
      const repeated = given.length - answers.length;
      const methods = answers.flatMap(({ left, right }) => [left, right]);
      this.#showResult(answers, '', methods.includes(OURS) ? OURS : null, 'all', repeated);
    } catch (error) {
      this.#fail(error);
    }
  }
}
