import { el, setText, together } from './dom';
import { icon } from './icons';
import { beingRead, upToDate } from './selectors';
import type { Mount } from './services';
import type { AppState } from './state';
import { apply, seedSet, stepsSet, watchAll } from './store';

/** A seed that nobody chose: small enough to read out and to type again. */
export function rolledSeed(): number {
  return 1 + Math.floor(Math.random() * 9999);
}

/** Which reaction of the many possible ones, how carefully it is made, and the order to make it. */
export const mountOptions: Mount = (root, store, services) => {
  const seed = el('input', {
    attributes: {
      type: 'number',
      min: 0,
      max: 0xffffffff,
      step: 1,
      'aria-label': 'Seed',
      inputmode: 'numeric',
    },
    on: {
      change: () => {
        apply(store, seedSet(seed.valueAsNumber));
        showSeed(store.getState());
      },
    },
  });
  const roll = button('dice', 'Roll a new seed', 'Another reaction (D)', () => {
    apply(store, seedSet(rolledSeed()));
  });
  const count = el('output', { attributes: { 'aria-label': 'Steps' } });
  const move = (by: number): void => {
    apply(store, stepsSet((store.getState().settings?.steps ?? 0) + by));
  };
  const fewer = button('minus', 'Fewer steps', 'Fewer steps: quicker, rougher', () => {
    move(-1);
  });
  const more = button('plus', 'More steps', 'More steps: slower, smoother', () => {
    move(1);
  });
  const make = el('button', {
    class: 'btn tint',
    text: 'Generate',
    attributes: { type: 'button' },
    on: {
      click: () => {
        services.generate();
      },
    },
  });
  const words = el('small');
  const section = el(
    'section',
    { class: 'sec options', attributes: { 'aria-label': 'Reaction' } },
    el(
      'div',
      { class: 'opts' },
      el('span', { class: 'num' }, el('span', { class: 'lbl', text: 'Seed' }), seed, roll),
      el('span', { class: 'grow' }),
      el('span', { class: 'num' }, el('span', { class: 'lbl', text: 'Steps' }), fewer, count, more),
    ),
    el('div', { class: 'make' }, make, words),
  );
  root.append(section);

  const showSeed = ({ settings }: AppState): void => {
    seed.value = settings ? String(settings.seed) : '';
  };
  const show = (state: AppState): void => {
    const { settings, manifest } = state;
    for (const control of [seed, roll, fewer, more]) control.disabled = !settings;
    if (settings && manifest) {
      const { min, max } = manifest.diffusion.steps;
      fewer.disabled = settings.steps <= min;
      more.disabled = settings.steps >= max;
      setText(count, String(settings.steps));
    }
    showSeed(state);
    make.disabled = !state.leader || !settings || state.job !== null;
    setText(words, makeWords(state));
  };
  return together(
    watchAll(
      store,
      (state) => [
        state.settings,
        state.manifest,
        state.leader,
        state.song,
        state.reaction,
        ...beingRead(state),
        state.job !== null,
      ],
      show,
    ),
    () => {
      section.remove();
    },
  );
};

function makeWords(state: AppState): string {
  if (!state.leader)
    return state.reading.leader ? 'Reading the leader' : 'Needs a leader; a song is optional.';
  if (state.job) return 'The reactor is being made.';
  if (state.reading.song) return 'Reading the song';
  if (upToDate(state)) return 'Follows every change by itself.';
  return state.reaction ? 'The settings have changed since.' : 'Ready.';
}

function button(
  name: Parameters<typeof icon>[0],
  label: string,
  title: string,
  run: () => void,
): HTMLButtonElement {
  return el(
    'button',
    { class: 'icon', attributes: { type: 'button', 'aria-label': label, title }, on: { click: run } },
    icon(name),
  );
}
