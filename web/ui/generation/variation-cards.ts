import { CHOICES } from '../store/actions/variations';
import { madeRole } from '../store/roles';
import { el, setAttribute, setText, setVariable, together } from '../widgets/dom';
import { headingOf } from '../../motion/skeleton/heading';
import { drawFigure } from '../widgets/figure';
import { icon } from '../widgets/icons';
import { token } from '../widgets/lane-canvas';
import { sameInputs } from '../store/selectors';
import type { Mount } from '../store/services';
import type { AppState, Reaction } from '../store/state';
import { watchAll } from '../store/store';

/** What one card shows. */
interface Card {
  readonly seed: number | null;
  readonly reaction: Reaction | null;
  readonly fraction: number;
}

/** Milliseconds between two pictures of a figure while it dances. */
const BEAT = 100;

/** The reactions to pick from, as little figures at the playhead; the one on the stage is marked. */
export const mountChoiceCards: Mount = (root, store, services) => {
  const cards = Array.from({ length: CHOICES }, (_, index) => {
    const canvas = el('canvas');
    const seed = el('span');
    const fill = el('i');
    const meter = el('span', { class: 'meter' }, fill);
    const button = el(
      'button',
      {
        class: 'react',
        attributes: { type: 'button', role: 'radio', 'aria-checked': 'false' },
        on: {
          click: () => {
            pick(index);
          },
          keydown: (event) => {
            const by = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[event.key];
            if (by === undefined) return;
            event.preventDefault();
            event.stopPropagation();
            step(index, by);
          },
        },
      },
      canvas,
      el('em', {}, icon('check')),
      seed,
      meter,
    );
    return { button, canvas, seed, fill, meter };
  });
  const group = el(
    'div',
    { class: 'reacts', attributes: { role: 'radiogroup', 'aria-label': 'Reactions to pick from' } },
    ...cards.map(({ button }) => button),
  );
  const spoken = el('p', { class: 'vh', attributes: { role: 'status' } });
  root.append(group, spoken);

  const pick = (index: number): void => {
    const card = shownCards(store.getState())[index];
    if (card?.seed !== null && card?.seed !== undefined) services.pickChoice(card.seed);
  };
  /** To the next card that holds something. */
  const step = (index: number, by: number): void => {
    const list = shownCards(store.getState());
    for (let turn = 1; turn < CHOICES; turn++) {
      const next = (index + by * turn + CHOICES * turn) % CHOICES;
      if (!list[next]?.reaction) continue;
      pick(next);
      cards[next]?.button.focus();
      return;
    }
  };

  const show = (state: AppState): void => {
    const list = shownCards(state);
    const onStage = list.findIndex(({ reaction }) => isOnStage(state, reaction));
    const first = Math.max(0, onStage);
    list.forEach(({ seed, reaction, fraction }, index) => {
      const card = cards[index];
      if (!card) return;
      const making = state.choices?.making === true && !reaction;
      setText(card.seed, seed === null ? '' : String(seed));
      card.button.disabled = reaction === null;
      card.button.classList.toggle('empty', reaction === null);
      card.meter.hidden = !making;
      setVariable(card.fill, '--part', fraction);
      setAttribute(card.button, 'aria-checked', index === onStage ? 'true' : 'false');
      setAttribute(card.button, 'tabindex', index === first ? 0 : -1);
      setAttribute(
        card.button,
        'aria-label',
        seed === null ? 'No reaction yet' : `Reaction, seed ${seed}${reaction ? '' : ', not made yet'}`,
      );
      card.button.title =
        reaction && index !== onStage ? 'Bring this one to the stage' : (reaction?.label ?? '');
    });
    const there = list.filter(({ reaction }) => reaction).length;
    setText(spoken, state.choices ? `${there} of ${CHOICES} reactions made.` : '');
  };

  let drawn = -Infinity;
  let due: ReturnType<typeof setTimeout> | undefined;
  const draw = (): void => {
    clearTimeout(due);
    const wait = drawn + BEAT - performance.now();
    if (wait > 0) {
      due = setTimeout(draw, wait);
      return;
    }
    drawn = performance.now();
    const state = store.getState();
    const list = shownCards(state);
    const poses = list.map(({ reaction }) => poseOf(state, reaction));
    const heading = headingOf(poses.find((pose) => pose !== null) ?? new Float32Array(66));
    const colour = token(root, `--figure-${madeRole(state)}`);
    poses.forEach((pose, index) => {
      const context = cards[index]?.canvas.getContext('2d');
      if (!context) return;
      const { canvas } = context;
      const ratio = Math.min(2, window.devicePixelRatio);
      const [width, height] = [canvas.clientWidth * ratio, canvas.clientHeight * ratio].map(Math.round);
      if (!width || !height) return;
      if (canvas.width !== width || canvas.height !== height) [canvas.width, canvas.height] = [width, height];
      if (pose) drawFigure(context, pose, heading, colour);
      else context.clearRect(0, 0, width, height);
    });
  };
  const sizes = new ResizeObserver(draw);
  sizes.observe(group);

  return together(
    watchAll(store, (state) => [state.choices, state.reaction, state.settings], show),
    watchAll(
      store,
      (state) => [
        state.choices?.list,
        state.reaction,
        state.theme,
        state.playback.time,
        state.settings?.role,
      ],
      draw,
    ),
    () => {
      clearTimeout(due);
      sizes.disconnect();
      group.remove();
      spoken.remove();
    },
  );
};

/** The choices, or in the first card what is on the stage. */
function shownCards({ choices, reaction }: AppState): readonly Card[] {
  if (choices) return choices.list;
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

function poseOf({ playback }: AppState, reaction: Reaction | null): Float32Array | null {
  if (!reaction) return null;
  const { motion } = reaction;
  const frame = Math.min(motion.frames - 1, Math.max(0, Math.round(playback.time * motion.fps)));
  return motion.positions.subarray(frame * 66, (frame + 1) * 66);
}
