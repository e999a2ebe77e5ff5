import { counted } from '../store/format';
import { textButton } from '../widgets/button';
import { el, setText } from '../widgets/dom';
import { USUAL_PAIRS } from './plan';
import type { Session } from './session';
import { contentOf, type StudySet } from './set';

/** What the setup asks for. */
interface SetupActions {
  /** Reads files that were chosen; the set is shown when it is there. */
  readonly chooseFiles: (files: readonly File[]) => void;
  readonly useBuiltIn: () => void;
  readonly start: (choice: { participant: string; pairs: number; seed: number | null }) => void;
  /** Goes on with the session that was kept. */
  readonly resume: () => void;
  /** Saves the answers of the session that was kept, which is kept no longer. */
  readonly save: (kept: Session) => void;
  readonly addAnswers: (files: readonly File[]) => void;
}

/** The beginning: who takes part, which dances are shown, how many pairs. */
export class SetupView {
  readonly element: HTMLElement;
  readonly #set = el('p', { attributes: { role: 'status' } });
  readonly #kept = el('div', { class: 'study-kept' });
  readonly #start: HTMLButtonElement;
  readonly #participant = el('input', { attributes: { type: 'text', maxlength: 60, autocomplete: 'off' } });
  readonly #pairs = el('input', { attributes: { type: 'number', min: 1, max: 200, step: 1 } });
  readonly #seed = el('input', {
    attributes: { type: 'number', min: 0, max: 2 ** 32 - 1, step: 1, placeholder: 'random' },
  });

  constructor(private readonly actions: SetupActions) {
    this.#pairs.value = String(USUAL_PAIRS);
    this.#start = el('button', { class: 'btn primary', text: 'Start', attributes: { type: 'submit' } });
    const form = el(
      'form',
      {
        on: {
          submit: (event) => {
            event.preventDefault();
            this.actions.start({
              participant: this.#participant.value.trim() || 'anonymous',
              pairs: Math.max(1, Math.round(Number(this.#pairs.value)) || USUAL_PAIRS),
              seed: this.#seed.value === '' ? null : Number(this.#seed.value) >>> 0,
            });
          },
        },
      },
      row('Participant', this.#participant),
      row('Pairs, at most', this.#pairs),
      row('Seed for the order', this.#seed),
      this.#start,
    );
    this.element = el(
      'section',
      { class: 'setup', attributes: { 'aria-label': 'Setup' } },
      el('h1', { text: 'Which partner dances better?' }),
      el('p', {
        text: 'You see a leader in blue twice, side by side, with two partners in orange: A on the left, B on the right. The music is the same. Watch as often as you like and answer three questions about each pair. Nothing tells which method made a partner, order and sides are random, and the answers stay on this device until you save them.',
      }),
      this.#kept,
      el('h2', { text: 'Dances' }),
      this.#set,
      el(
        'div',
        { class: 'study-actions' },
        textButton('btn tint', 'Dances of this page', this.actions.useBuiltIn),
        chooser('Choose files', '', this.actions.chooseFiles),
      ),
      el('p', {
        class: 'file-help',
        text: 'Files are named DUET_leader.bvh and DUET_METHOD.bvh, with two methods or more, as salsa_ours.bvh and salsa_truth.bvh, in any format that the page reads; DUET.mp3 is the music. Where one method is called “ours”, the others are compared with it.',
      }),
      el('h2', { text: 'Participant' }),
      form,
      el('h2', { text: 'Summary of several participants' }),
      chooser('Combine saved answers', '.csv', this.actions.addAnswers),
    );
  }

  /** @param waiting what is being read; null where the set is there or none is */
  show(set: StudySet | null, waiting: string | null, kept: Session | null): void {
    setText(this.#set, waiting ?? (set ? describe(set) : 'None are chosen yet.'));
    this.#start.disabled = set === null || waiting !== null;
    this.#kept.replaceChildren(...(kept ? this.#keptParts(kept, set) : []));
    this.#kept.hidden = kept === null;
  }

  /** Shows that a new test would replace answers that are not saved. */
  askBeforeReplacing(kept: Session, start: () => void): void {
    const save = this.#saveButton(kept);
    this.#kept.replaceChildren(
      el('p', { text: `A new test replaces the answers of ${kept.participant}, which are not saved yet.` }),
      save,
      ' ',
      textButton('btn ghost', 'Start without saving them', start),
    );
    // It is above the form, out of sight on a small screen.
    save.focus();
  }

  #saveButton(kept: Session): HTMLButtonElement {
    return textButton('btn tint', 'Save answers (CSV)', () => {
      this.actions.save(kept);
    });
  }

  #keptParts(kept: Session, set: StudySet | null): HTMLElement[] {
    if (kept.finished)
      return [
        el('p', { text: `The answers of ${kept.participant} are not saved yet.` }),
        this.#saveButton(kept),
      ];
    const answered = new Set(kept.answers.map(({ pair }) => pair)).size;
    const text = `The test of ${kept.participant} is not finished: ${answered} of ${kept.pairs.length} pairs.`;
    if (set && contentOf(set) === kept.content)
      return [el('p', { text }), textButton('btn tint', 'Continue', this.actions.resume)];
    return [
      el('p', { text: `${text} Choose the same dances to continue; starting another one replaces it.` }),
    ];
  }
}

function describe({ name, reference, duets }: StudySet): string {
  const methods = [...new Set(duets.flatMap((duet) => duet.methods))];
  const count = `${counted(duets.length, 'leader')}, ${counted(methods.length, 'method')}`;
  const music = duets.every(({ song }) => song) ? '' : ', some without music';
  const against = reference === null ? 'all compared with each other' : `compared with “${reference}”`;
  return `${name === 'files' ? 'Your files' : 'The dances of this page'}: ${count}${music}, ${against}.`;
}

function row(text: string, control: HTMLElement): HTMLElement {
  return el('label', {}, el('span', { text }), control);
}

/** A button that opens the system's file chooser. */
function chooser(text: string, accept: string, choose: (files: readonly File[]) => void): HTMLElement {
  const input = el('input', {
    attributes: { type: 'file', multiple: true, accept, hidden: true, 'aria-label': text },
    on: {
      change: () => {
        const files = [...(input.files ?? [])];
        input.value = '';
        if (files.length > 0) choose(files);
      },
    },
  });
  return el(
    'span',
    {},
    input,
    textButton('btn tint', text, () => {
      input.click();
    }),
  );
}
