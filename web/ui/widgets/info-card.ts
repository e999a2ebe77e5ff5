import { el, setText, setVariable } from './dom';

/** How a number compares with its reference. */
export type Verdict = 'good' | 'so-so' | 'poor';

/** One measure at a glance. */
export interface MeasureRow {
  readonly name: string;
  /** A few words on what the number is. */
  readonly hint: string;
  readonly value: string;
  /** What it is compared with: `recorded 33 %`; empty when nothing is known. */
  readonly beside: string;
  /** Null where there is nothing to compare it with. */
  readonly verdict: Verdict | null;
}

/** What a card says: what it is about, a number or a time beside it, measures, and what that means in sentences. */
export interface CardContent {
  readonly title: string;
  readonly aside: string;
  readonly rows?: readonly MeasureRow[];
  readonly text: string;
}

/** Rest of the pointer before the card opens, and time to move over to the card before it closes. */
const HOVER_DELAY_MS = 150;
/** Room between button and card, and between card and the window's edge. */
const GAP_PX = 8;

/**
 * One card for many small buttons, floating beside the one it is about, so that nothing on the page moves. It opens
 * while the pointer rests on a button, while the button has the focus, and after a tap; Escape or a tap elsewhere
 * closes it.
 */
export class InfoCard {
  private readonly title = el('b');
  private readonly aside = el('span');
  private readonly measures = el('ul', { class: 'measures' });
  private readonly text = el('p');
  private readonly card = el(
    'div',
    { class: 'info-card', attributes: { id: 'info-card', role: 'tooltip', popover: 'auto' } },
    el('div', { class: 'top' }, this.title, this.aside),
    this.measures,
    this.text,
  );
  private readonly contents = new WeakMap<HTMLElement, CardContent>();
  /** The button whose card is open. */
  private current: HTMLElement | null = null;
  /** The button that has the focus by the keyboard, not by a click. */
  private reachedByKey: HTMLElement | null = null;
  private timer: ReturnType<typeof setTimeout> | undefined;

  /** @param keepClear the element that a card with measures is about: the card goes above it where there is room */
  constructor(private readonly keepClear: HTMLElement) {
    document.body.append(this.card);
    this.listenToCard();
    new ResizeObserver(() => {
      this.close();
    }).observe(document.documentElement);
  }

  /** Gives a button a card with this content, or new content for the card that it has. */
  set(button: HTMLElement, content: CardContent): void {
    if (!this.contents.has(button)) this.listenTo(button);
    this.contents.set(button, content);
    if (this.current !== button) return;
    this.fill(button);
    this.place();
  }

  private listenTo(button: HTMLElement): void {
    const open = (): void => {
      this.open(button);
    };
    button.addEventListener('pointerenter', ({ pointerType }) => {
      if (pointerType !== 'mouse') return;
      clearTimeout(this.timer);
      this.timer = setTimeout(() => {
        if (button.isConnected) open();
      }, HOVER_DELAY_MS);
    });
    button.addEventListener('pointerleave', this.closeSoon);
    button.addEventListener('focus', () => {
      this.reachedByKey = button.matches(':focus-visible') ? button : null;
      open();
    });
    // A tap need not give the focus, and the press itself has closed an open card.
    button.addEventListener('click', open);
    button.addEventListener('blur', () => {
      this.reachedByKey = null;
      this.close();
    });
  }

  private listenToCard(): void {
    this.card.addEventListener('pointerenter', () => {
      clearTimeout(this.timer);
    });
    this.card.addEventListener('pointerleave', this.closeSoon);
    this.card.addEventListener('toggle', ({ newState }) => {
      if (newState !== 'closed') return;
      this.current?.removeAttribute('aria-describedby');
      this.current = null;
    });
  }

  private open(button: HTMLElement): void {
    clearTimeout(this.timer);
    if (this.current !== button) this.current?.removeAttribute('aria-describedby');
    this.current = button;
    this.fill(button);
    button.setAttribute('aria-describedby', this.card.id);
    if (!this.card.matches(':popover-open')) this.card.showPopover();
    this.place();
  }

  private close(): void {
    clearTimeout(this.timer);
    if (this.card.matches(':popover-open')) this.card.hidePopover();
  }

  /** The pointer has left button or card: a button that was reached by the keyboard keeps its card. */
  private readonly closeSoon = ({ pointerType }: PointerEvent): void => {
    if (pointerType !== 'mouse') return;
    clearTimeout(this.timer);
    if (this.current && this.current === this.reachedByKey) return;
    this.timer = setTimeout(() => {
      this.close();
    }, HOVER_DELAY_MS);
  };

  private fill(button: HTMLElement): void {
    const content = this.contents.get(button);
    setText(this.title, content?.title ?? '');
    setText(this.aside, content?.aside ?? '');
    const rows = content?.rows ?? [];
    this.measures.hidden = rows.length === 0;
    this.measures.replaceChildren(...rows.map(measureLine));
    setText(this.text, content?.text ?? '');
    this.text.hidden = this.text.textContent === '';
  }

  /** Above the button, or above what is to be kept clear; below the button where there is no room. */
  private place(): void {
    if (!this.current) return;
    const { clientWidth, clientHeight } = document.documentElement;
    const at = this.current.getBoundingClientRect();
    const { offsetWidth: width, offsetHeight: height } = this.card;
    const middle = at.left + Math.min(at.width, width) / 2;
    const left = Math.min(clientWidth - GAP_PX - width, middle - width / 2);
    const top = this.measures.hidden ? at.top : this.keepClear.getBoundingClientRect().top;
    const above = (top - GAP_PX - height >= GAP_PX ? top : at.top) - GAP_PX - height;
    const below = Math.min(at.bottom + GAP_PX, clientHeight - GAP_PX - height);
    setVariable(this.card, '--x', Math.round(Math.max(GAP_PX, left)));
    setVariable(this.card, '--y', Math.round(Math.max(GAP_PX, above >= GAP_PX ? above : below)));
  }
}

const PIPS = { good: 3, 'so-so': 2, poor: 1 } as const;

/** One measure: its name over its hint, the number, what it is compared with, and the verdict with up to three pips. */
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
