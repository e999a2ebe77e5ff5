import { onPixelSize } from '../../common/pixel-size';
import { allVariationsMade, VARIATION_COUNT } from '../store/actions/variations';
import { el, setAttribute, setText, setVariable } from '../widgets/dom';
import { icon } from '../widgets/icons';
import { ARROW_STEPS } from '../widgets/radio-group';
import { clockTime } from '../store/format';
import { danceFps, sameInputs } from '../store/selectors';
import type { Mount } from '../store/services';
import type { Reaction } from '../store/reaction';
import type { AppState, Variation } from '../store/state';
import { watchAll } from '../store/store';
import { drawFigures, sharedFrame } from './variation-figures';

/** How a card is shown: whether its reaction is on the stage or being made, and whether Tab leads to the card. */
interface CardState {
  readonly onStage: boolean;
  readonly making: boolean;
  readonly tabStop: boolean;
  /** Seconds of the dance that all cards show; null where they follow the playhead. */
  readonly moment: number | null;
}

interface Card {
  readonly button: HTMLButtonElement;
  readonly canvas: HTMLCanvasElement;
  readonly show: (variation: Variation, state: CardState) => void;
}

/** Least time between two drawings of the figures. */
const DRAW_INTERVAL_MS = 250;

/**
 * The variations to pick from, as small figures in the moment in which they differ most; the one on the stage is marked.
 * Until all are there they show the moment at which the playhead rests. Without WebGL there are no figures.
 */
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

  const canvases = cards.map(({ canvas }) => canvas);
  const figures = throttle(() => {
    const state = store.getState();
    const reactions = cardContents(state).map(({ reaction }) => reaction);
    if (services.drawFigure) drawFigures(canvases, reactions, state, services.drawFigure);
  }, DRAW_INTERVAL_MS);
  onPixelSize(group, figures);
  watchAll(
    store,
    (state) => [state.variations, state.reaction, state.settings],
    (state) => {
      showCards(cards, state);
      setText(spoken, state.variations ? madeText(state.variations.list) : '');
    },
  );
  watchAll(
    store,
    ({ variations, reaction, theme, playback, settings }) => [
      variations?.list,
      reaction,
      theme,
      allVariationsMade(variations) || playback.playing ? null : playback.time,
      settings?.role,
    ],
    figures,
  );
};

function createCard(onPick: () => void, onArrow: (by: number) => void): Card {
  const canvas = el('canvas');
  const seedText = el('span', { class: 'seed' });
  const momentText = el('span', { class: 'moment' });
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
          const by = ARROW_STEPS[event.key];
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
    momentText,
    meter,
  );
  return {
    button,
    canvas,
    show: ({ seed, reaction, fraction }, { onStage, making, tabStop, moment }) => {
      setText(seedText, seed === null ? '' : String(seed));
      setText(momentText, moment === null ? '' : clockTime(moment));
      button.disabled = reaction === null;
      button.classList.toggle('empty', reaction === null);
      meter.hidden = !making;
      setVariable(fill, '--part', fraction);
      setAttribute(button, 'aria-checked', String(onStage));
      setAttribute(button, 'tabindex', tabStop ? 0 : -1);
      const shown = moment === null ? '' : `, shown at ${clockTime(moment)}`;
      const label = `Reaction, seed ${seed}${reaction ? shown : ', not made yet'}`;
      setAttribute(button, 'aria-label', seed === null ? 'No reaction yet' : label);
      button.title = reaction && !onStage ? 'Show this one on the stage' : (reaction?.label ?? '');
    },
  };
}

function showCards(cards: readonly Card[], state: AppState): void {
  const contents = cardContents(state);
  const onStage = contents.findIndex(({ reaction }) => isOnStage(state, reaction));
  const frame = sharedFrame(state);
  const moment = frame === null ? null : frame / danceFps(state);
  contents.forEach((content, index) => {
    cards[index]?.show(content, {
      moment,
      onStage: index === onStage,
      making: state.variations?.making === true && !content.reaction,
      tabStop: index === Math.max(0, onStage),
    });
  });
}

function madeText(list: readonly Variation[]): string {
  return `${list.filter(({ reaction }) => reaction).length} of ${VARIATION_COUNT} reactions made.`;
}

/** The variations; where none is made or being made, the reaction on the stage in the first card. */
export function cardContents({
  variations,
  reaction,
}: Pick<AppState, 'variations' | 'reaction'>): readonly Variation[] {
  if (variations && (variations.making || variations.list.some((one) => one.reaction)))
    return variations.list;
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

/** Runs `action` at once, but at most every `interval` milliseconds: later calls in between share one late run. */
function throttle(action: () => void, interval: number): () => void {
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
  return run;
}
