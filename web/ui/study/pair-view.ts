import { el, setText, UNTRANSLATED } from '../widgets/dom';
import { textButton } from '../widgets/button';
import type { CRITERIA } from './answers';
import { CHOICES, type Criterion } from './answers';

/** What the visitor does with a pair. */
interface PairActions {
  readonly togglePlay: () => void;
  readonly seek: (seconds: number) => void;
  readonly answer: (criterion: Criterion, score: number) => void;
  readonly back: () => void;
  readonly next: () => void;
  readonly retry: () => void;
}

/** What is shown of a pair. */
export interface PairState {
  /** From 0. */
  readonly number: number;
  readonly pairs: number;
  readonly criteria: readonly (typeof CRITERIA)[number][];
  readonly answers: ReadonlyMap<Criterion, number>;
  /** What is being done where the dances are not there yet; null where they are. */
  readonly waiting: string | null;
  /** The dances could not be made. */
  readonly failed: boolean;
}

/** Whether the dances are on the stage. */
function areShown({ waiting, failed }: PairState): boolean {
  return waiting === null && !failed;
}

/** A button does what it says itself, and a space chooses what has the focus. */
function isForElement({ key, target }: KeyboardEvent): boolean {
  if (target instanceof HTMLButtonElement) return true;
  const isUnchosen = target instanceof HTMLInputElement && target.type === 'radio' && !target.checked;
  return key === ' ' && isUnchosen;
}

/** The questions beside the stage, and the transport below them. */
export class PairView {
  readonly element: HTMLElement;
  readonly #heading = el('h1', { attributes: { tabindex: -1 } });
  readonly #waiting = el('p', { class: 'study-waiting', attributes: { role: 'status' } });
  readonly #questions = el('div', { class: 'questions' });
  readonly #play: HTMLButtonElement;
  readonly #slider: HTMLInputElement;
  readonly #clock = el('span', { class: 'study-time' });
  readonly #next: HTMLButtonElement;
  readonly #back: HTMLButtonElement;
  readonly #retry: HTMLButtonElement;
  #state: PairState | null = null;

  constructor(private readonly actions: PairActions) {
    this.#play = textButton('btn primary', 'Play', actions.togglePlay);
    this.#slider = el('input', {
      attributes: { type: 'range', min: 0, step: 0.05, 'aria-label': 'Time' },
      on: {
        input: () => {
          actions.seek(Number(this.#slider.value));
        },
      },
    });
    this.#next = textButton('btn primary', 'Next pair', actions.next);
    this.#back = textButton('btn ghost', 'Back', actions.back);
    this.#retry = textButton('btn primary', 'Try again', actions.retry);
    this.element = el(
      'section',
      { class: 'pair', attributes: { 'aria-label': 'Questions' } },
      this.#heading,
      this.#waiting,
      this.#retry,
      el('div', { class: 'study-transport' }, this.#play, this.#slider, this.#clock),
      this.#questions,
      el('div', { class: 'study-actions' }, this.#back, this.#next),
      el('p', {
        class: 'key-help',
        text: 'Keys: Space plays and pauses, 1 to 5 answer the next open question, then the one in focus, Enter goes on, Backspace goes back.',
      }),
    );
  }

  /** @param isNew a pair that was not shown before gets the focus */
  show(state: PairState, isNew: boolean): void {
    const { number, pairs, criteria, answers, waiting, failed } = state;
    const isReady = areShown(state);
    this.#state = state;
    setText(this.#heading, `Pair ${number + 1} of ${pairs}`);
    setText(this.#waiting, waiting ?? '');
    this.#waiting.hidden = waiting === null;
    this.#retry.hidden = !failed;
    this.#play.disabled = this.#slider.disabled = !isReady;
    if (!isReady) {
      // Without a value a slider stands in its middle.
      this.#slider.value = '0';
      setText(this.#clock, '');
    }
    if (isNew) {
      this.#questions.replaceChildren(...criteria.map((criterion) => this.#question(criterion)));
      this.#heading.focus();
    }
    // Nobody answers before the dances were seen.
    for (const fieldset of this.#questions.querySelectorAll('fieldset')) fieldset.disabled = !isReady;
    for (const { id } of criteria)
      for (const input of this.#questions.querySelectorAll<HTMLInputElement>(`input[name="${id}"]`))
        input.checked = Number(input.value) === answers.get(id);
    this.#back.disabled = number === 0;
    this.#next.disabled = criteria.some(({ id }) => !answers.has(id));
    setText(this.#next, number + 1 < pairs ? 'Next pair' : 'Finish');
  }

  showTime(seconds: number, duration: number, playing: boolean): void {
    this.#slider.max = String(duration);
    this.#slider.value = String(seconds);
    // Screen readers read out each change of the slider that has the focus, over the music.
    if (!playing || this.#slider !== document.activeElement)
      this.#slider.setAttribute('aria-valuetext', `${seconds.toFixed(1)} seconds`);
    setText(this.#clock, `${seconds.toFixed(1)} / ${duration.toFixed(1)} s`);
    setText(this.#play, playing ? 'Pause' : 'Play');
  }

  /** Keys of the whole page while a pair is shown; true where the key meant something. */
  handleKey(event: KeyboardEvent): boolean {
    const state = this.#state;
    if (!state || event.ctrlKey || event.metaKey || event.altKey) return false;
    const choice = CHOICES[Number(event.key) - 1];
    if (choice) return this.#answerByKey(state, choice.score, event);
    return !isForElement(event) && this.#act(state, event);
  }

  /** Answers the next open question, else the one in focus; false where there is none. */
  #answerByKey(state: PairState, score: number, { repeat, target }: KeyboardEvent): boolean {
    // A key that is held answers one question.
    if (!areShown(state) || repeat) return false;
    const { criteria, answers } = state;
    const focused = target instanceof HTMLInputElement ? target.name : '';
    const question = criteria.find(({ id }) => !answers.has(id)) ?? criteria.find(({ id }) => id === focused);
    if (question) this.actions.answer(question.id, score);
    return question !== undefined;
  }

  /** Plays or pauses, goes on or goes back; false for other keys, and where this is not possible. */
  #act(state: PairState, { key, repeat }: KeyboardEvent): boolean {
    if (key === ' ' && areShown(state)) {
      if (!repeat) this.actions.togglePlay();
    } else if (repeat) return false;
    else if (key === 'Enter' && !this.#next.disabled) this.actions.next();
    else if (key === 'Backspace' && state.number > 0) this.actions.back();
    else return false;
    return true;
  }

  #question({ id, question }: (typeof CRITERIA)[number]): HTMLElement {
    return el(
      'fieldset',
      {},
      el('legend', { text: question }),
      el(
        'div',
        { class: 'likert' },
        ...CHOICES.map(({ score, text }, i) =>
          el(
            'label',
            {},
            el('input', {
              attributes: { type: 'radio', name: id, value: score },
              on: {
                change: () => {
                  this.actions.answer(id, score);
                },
              },
            }),
            el('span', { text }),
            el('kbd', { text: String(i + 1), attributes: { 'aria-hidden': 'true', ...UNTRANSLATED } }),
          ),
        ),
      ),
    );
  }
}
