import { el, setText, setVariable, together } from './dom';

/** How a number stands beside its reference. */
export type Verdict = 'good' | 'so-so' | 'poor';

/** One measure at a glance. */
export interface MeasureRow {
  readonly name: string;
  /** A few words on what the number is. */
  readonly hint: string;
  readonly value: string;
  /** What it is held against: `recorded 33 %`; empty when nothing is known. */
  readonly beside: string;
  /** Null where there is nothing to hold it against. */
  readonly verdict: Verdict | null;
}

/** What a card says: what it is about, a number or a moment beside it, measures, and what that means in sentences. */
export interface Explanation {
  readonly title: string;
  readonly aside: string;
  readonly rows?: readonly MeasureRow[];
  readonly text: string;
}

export interface Explainer {
  /**
   * Explains a button while the pointer rests on it, while it has the focus, and after a tap; Escape or a tap elsewhere
   * puts the card away. Called again, the words change.
   */
  readonly explain: (button: HTMLElement, words: Explanation) => void;
  readonly dispose: () => void;
}

/** Rest of the pointer before the card comes, and time to move over to the card before it goes, milliseconds. */
const REST = 150;
/** Room between button and card, and between card and the window's edge, CSS pixels. */
const GAP = 8;

/**
 * One card for many small things, floating beside the one it explains, so that nothing on the page moves.
 * @param clear what a card with measures is about: it leaves that in sight where there is room above it
 */
export function createExplainer(clear: HTMLElement): Explainer {
  const title = el('b');
  const aside = el('span');
  const measures = el('ul', { class: 'measures' });
  const text = el('p');
  const card = el(
    'div',
    { class: 'explained', attributes: { id: 'explained', role: 'tooltip', popover: 'auto' } },
    el('div', { class: 'top' }, title, aside),
    measures,
    text,
  );
  document.body.append(card);

  const words = new WeakMap<HTMLElement, Explanation>();
  let about: HTMLElement | null = null;
  let timer: ReturnType<typeof setTimeout> | undefined;

  const place = (): void => {
    if (!about) return;
    const at = about.getBoundingClientRect();
    const { offsetWidth: width, offsetHeight: height } = card;
    const middle = at.left + Math.min(at.width, width) / 2;
    const left = Math.min(document.documentElement.clientWidth - GAP - width, middle - width / 2);
    const top = measures.hidden ? at.top : clear.getBoundingClientRect().top;
    const above = (top - GAP - height >= GAP ? top : at.top) - GAP - height;
    const below = Math.min(at.bottom + GAP, document.documentElement.clientHeight - GAP - height);
    setVariable(card, '--x', Math.round(Math.max(GAP, left)));
    setVariable(card, '--y', Math.round(Math.max(GAP, above >= GAP ? above : below)));
  };
  const fill = (button: HTMLElement): void => {
    const explanation = words.get(button);
    setText(title, explanation?.title ?? '');
    setText(aside, explanation?.aside ?? '');
    const rows = explanation?.rows ?? [];
    measures.hidden = rows.length === 0;
    measures.replaceChildren(...rows.map(measureLine));
    setText(text, explanation?.text ?? '');
    text.hidden = text.textContent === '';
  };
  const show = (button: HTMLElement): void => {
    clearTimeout(timer);
    if (about !== button) about?.removeAttribute('aria-describedby');
    about = button;
    fill(button);
    button.setAttribute('aria-describedby', card.id);
    if (!card.matches(':popover-open')) card.showPopover();
    place();
  };
  const hide = (): void => {
    clearTimeout(timer);
    if (card.matches(':popover-open')) card.hidePopover();
  };
  /** The pointer has left button and card: the one that the keyboard is on keeps its card. */
  const leave = ({ pointerType }: PointerEvent): void => {
    if (pointerType !== 'mouse') return;
    clearTimeout(timer);
    if (!about?.matches(':focus-visible')) timer = setTimeout(hide, REST);
  };
  card.addEventListener('pointerenter', () => {
    clearTimeout(timer);
  });
  card.addEventListener('pointerleave', leave);
  card.addEventListener('toggle', ({ newState }) => {
    if (newState !== 'closed') return;
    about?.removeAttribute('aria-describedby');
    about = null;
  });
  const listenTo = (button: HTMLElement): void => {
    button.addEventListener('pointerenter', ({ pointerType }) => {
      if (pointerType !== 'mouse') return;
      clearTimeout(timer);
      timer = setTimeout(() => {
        if (button.isConnected) show(button);
      }, REST);
    });
    button.addEventListener('pointerleave', leave);
    button.addEventListener('focus', () => {
      show(button);
    });
    // A tap need not give the focus, and the press itself has put an open card away.
    button.addEventListener('click', () => {
      show(button);
    });
    button.addEventListener('blur', hide);
  };
  const resized = new ResizeObserver(hide);
  resized.observe(document.documentElement);

  return {
    explain: (button, explanation) => {
      if (!words.has(button)) listenTo(button);
      words.set(button, explanation);
      if (about !== button) return;
      fill(button);
      place();
    },
    dispose: together(
      () => {
        clearTimeout(timer);
        resized.disconnect();
      },
      () => {
        card.remove();
      },
    ),
  };
}

const PIPS = { good: 3, 'so-so': 2, poor: 1 } as const;

/** One measure: its name over what it is, the number, what it is held against, and a word on that with three pips. */
function measureLine({ name, hint, value, beside, verdict }: MeasureRow): HTMLElement {
  return el(
    'li',
    {},
    el('span', { class: 'what' }, el('span', { text: name }), ' ', el('small', { text: hint })),
    el('b', { text: value }),
    ' ',
    el(
      'span',
      { class: 'beside' },
      ...beside.split(', ').flatMap((line) => [el('small', { text: line }), ' ']),
    ),
    el(
      'span',
      { class: `verdict ${verdict ?? ''}` },
      verdict && pips(PIPS[verdict]),
      el('span', { text: verdict ?? '' }),
    ),
  );
}

function pips(count: number): HTMLElement {
  const all = [1, 2, 3].map((pip) => el('i', { class: pip <= count ? 'on' : '' }));
  return el('span', { class: 'pips', attributes: { 'aria-hidden': 'true' } }, ...all);
}
