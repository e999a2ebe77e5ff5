import { VARIATION_COUNT } from '../store/actions/variations';
import { generatedRole } from '../store/roles';
import { el, setAttribute, setText, setVariable, combineDisposers } from '../widgets/dom';
import { headingOf } from '../../motion/skeleton/heading';
import { drawFigure } from '../widgets/figure';
import { icon } from '../widgets/icons';
import { token } from '../widgets/lane-canvas';
import { sameInputs } from '../store/selectors';
import type { Mount } from '../store/services';
import type { Reaction } from '../store/reaction';
import type { AppState, Variation } from '../store/state';
import { watchAll } from '../store/store';

/** A variation, or an empty place for one. */
type CardContent = Omit<Variation, 'seed'> & { readonly seed: number | null };

/** How a card is shown: whether its reaction is on the stage or being made, and whether Tab leads to the card. */
interface CardState {
  readonly onStage: boolean;
  readonly making: boolean;
  readonly tabStop: boolean;
}

interface Card {
  readonly button: HTMLButtonElement;
  readonly canvas: HTMLCanvasElement;
  readonly show: (content: CardContent, state: CardState) => void;
}

/** Time between two drawings of the figures while they dance. */
const DRAW_INTERVAL_MS = 100;

/** Steps between cards, by key. */
const ARROWS: Readonly<Record<string, number>> = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 };

/** The variations to pick from, as small figures posed at the playhead; the one on the stage is marked. */
export const mountVariationCards: Mount = (root, store, services) => {
  const pick = (index: number): void => {
    const seed = cardContents(store.getState())[index]?.seed ?? null;
    if (seed !== null) services.pickVariation(seed);
  };
  /** To the next card that has a reaction. */
  const step = (index: number, by: number): void => {
    const contents = cardContents(store.getState());
    for (let distance = 1; distance < VARIATION_COUNT; distance++) {
      const next = (index + by * distance + VARIATION_COUNT * distance) % VARIATION_COUNT;
      if (!contents[next]?.reaction) continue;
      pick(next);
      cards[next]?.button.focus();
      return;
    }
  };
  const cards = Array.from({ length: VARIATION_COUNT }, (_, index) =>
    createCard(
      () => {
        pick(index);
      },
      (by) => {
        step(index, by);
      },
    ),
  );
  const group = el(
    'div',
    { class: 'variations', attributes: { role: 'radiogroup', 'aria-label': 'Reactions to pick from' } },
    ...cards.map(({ button }) => button),
  );
  const spoken = el('p', { class: 'visually-hidden', attributes: { role: 'status' } });
  root.append(group, spoken);

  const figures = throttle(() => {
    drawFigures(root, cards, store.getState());
  }, DRAW_INTERVAL_MS);
  const sizes = new ResizeObserver(figures.run);
  sizes.observe(group);
  return combineDisposers(
    watchAll(
      store,
      (state) => [state.variations, state.reaction, state.settings],
      (state) => {
        showCards(cards, state);
        setText(spoken, state.variations ? madeText(state.variations.list) : '');
      },
    ),
    watchAll(
      store,
      ({ variations, reaction, theme, playback, settings }) => [
        variations?.list,
        reaction,
        theme,
        playback.time,
        settings?.role,
      ],
      figures.run,
    ),
    () => {
      figures.cancel();
      sizes.disconnect();
      group.remove();
      spoken.remove();
    },
  );
};

function createCard(onPick: () => void, onArrow: (by: number) => void): Card {
  const canvas = el('canvas');
  const seedText = el('span');
  const fill = el('i');
  const meter = el('span', { class: 'meter' }, fill);
  const button = el(
    'button',
    {
      class: 'variation',
      attributes: { type: 'button', role: 'radio', 'aria-checked': 'false' },
      on: {
        click: onPick,
        keydown: (event) => {
          const by = ARROWS[event.key];
          if (by === undefined) return;
          event.preventDefault();
          event.stopPropagation();
          onArrow(by);
        },
      },
    },
    canvas,
    el('em', {}, icon('check')),
    seedText,
    meter,
  );
  return {
    button,
    canvas,
    show: ({ seed, reaction, fraction }, { onStage, making, tabStop }) => {
      setText(seedText, seed === null ? '' : String(seed));
      button.disabled = reaction === null;
      button.classList.toggle('empty', reaction === null);
      meter.hidden = !making;
      setVariable(fill, '--part', fraction);
      setAttribute(button, 'aria-checked', String(onStage));
      setAttribute(button, 'tabindex', tabStop ? 0 : -1);
      const label = `Reaction, seed ${seed}${reaction ? '' : ', not made yet'}`;
      setAttribute(button, 'aria-label', seed === null ? 'No reaction yet' : label);
      button.title = reaction && !onStage ? 'Bring this one to the stage' : (reaction?.label ?? '');
    },
  };
}

function showCards(cards: readonly Card[], state: AppState): void {
  const contents = cardContents(state);
  const onStage = contents.findIndex(({ reaction }) => isOnStage(state, reaction));
  contents.forEach((content, index) => {
    cards[index]?.show(content, {
      onStage: index === onStage,
      making: state.variations?.making === true && !content.reaction,
      tabStop: index === Math.max(0, onStage),
    });
  });
}

function madeText(list: readonly Variation[]): string {
  return `${list.filter(({ reaction }) => reaction).length} of ${VARIATION_COUNT} reactions made.`;
}

/** The variations; without any, the reaction on the stage in the first card. */
function cardContents({ variations, reaction }: AppState): readonly CardContent[] {
  if (variations) return variations.list;
  const none = { seed: null, reaction: null, fraction: 0 };
  const first = reaction ? { seed: reaction.inputs.settings.seed, reaction, fraction: 1 } : none;
  return [first, none, none];
}

function isOnStage(state: AppState, reaction: Reaction | null): boolean {
  return (
    reaction !== null &&
    (reaction === state.reaction || sameInputs(reaction.inputs, state.reaction?.inputs ?? null))
  );
}

/** Draws each card's dancer at the playhead, all seen from the same direction. */
function drawFigures(root: HTMLElement, cards: readonly Card[], state: AppState): void {
  const poses = cardContents(state).map(({ reaction }) => reaction && poseAt(reaction, state.playback.time));
  const direction = headingOf(poses.find((pose) => pose !== null) ?? new Float32Array(66));
  const colour = token(root, `--figure-${generatedRole(state)}`);
  poses.forEach((pose, index) => {
    const context = cards[index]?.canvas.getContext('2d');
    if (!context || !fitCanvas(context.canvas)) return;
    if (pose) drawFigure(context, pose, direction, colour);
    else context.clearRect(0, 0, context.canvas.width, context.canvas.height);
  });
}

/** Joint positions (22 x 3, metres) of the frame nearest to `time`, seconds. */
function poseAt({ motion }: Reaction, time: number): Float32Array {
  const frame = Math.min(motion.frames - 1, Math.max(0, Math.round(time * motion.fps)));
  return motion.positions.subarray(frame * 66, (frame + 1) * 66);
}

/** Gives the canvas the pixels of its element; false while it has no size. */
function fitCanvas(canvas: HTMLCanvasElement): boolean {
  const ratio = Math.min(2, window.devicePixelRatio);
  const width = Math.round(canvas.clientWidth * ratio);
  const height = Math.round(canvas.clientHeight * ratio);
  if (width === 0 || height === 0) return false;
  if (canvas.width !== width || canvas.height !== height) [canvas.width, canvas.height] = [width, height];
  return true;
}

/** Runs `action` at once, but at most every `interval` milliseconds: later calls in between share one late run. */
function throttle(
  action: () => void,
  interval: number,
): { readonly run: () => void; readonly cancel: () => void } {
  let last = -Infinity;
  let timer: ReturnType<typeof setTimeout> | undefined;
  const run = (): void => {
    clearTimeout(timer);
    const wait = last + interval - performance.now();
    if (wait > 0) {
      timer = setTimeout(run, wait);
      return;
    }
    last = performance.now();
    action();
  };
  return {
    run,
    cancel: () => {
      clearTimeout(timer);
    },
  };
}
