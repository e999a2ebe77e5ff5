import { mountChoiceCards } from './variation-cards';
import { allVariationsMade } from '../store/actions/variations';
import { loadedRole, generatedRole } from '../store/roles';
import { el, setText, together } from '../widgets/dom';
import { icon } from '../widgets/icons';
import { mountSeedBox } from './seed-box';
import { isReading, upToDate } from '../store/selectors';
import type { Mount } from '../store/services';
import type { AppState } from '../store/state';
import { rolesSwapped, seedRolled, stepsSet, rolledSeed } from '../store/actions/settings';
import { apply, watchAll } from '../store/store';

/** Which of the many possible reactions, how carefully it is made, whose part it is, and the order to make it. */
export const mountOptions: Mount = (root, store, services) => {
  const count = el('output', { attributes: { 'aria-label': 'Steps' } });
  const move = (by: number): void => {
    apply(store, stepsSet((store.getState().settings?.steps ?? 0) + by));
  };
  const fewer = stepper('minus', 'Fewer steps', 'Fewer steps: quicker, rougher', () => {
    move(-1);
  });
  const more = stepper('plus', 'More steps', 'More steps: slower, smoother', () => {
    move(1);
  });
  const swap = el(
    'button',
    {
      class: 'btn tint swap',
      attributes: { type: 'button' },
      on: {
        click: () => {
          apply(store, rolesSwapped());
        },
      },
    },
    icon('swap'),
    'Swap roles',
  );
  const make = el('button', {
    class: 'btn tint',
    attributes: { type: 'button' },
    on: {
      click: () => {
        const state = store.getState();
        // With a reaction to the very wish on the stage, another one is another seed, unless that is locked.
        if (upToDate(state) && !state.seedLocked) apply(store, seedRolled(rolledSeed()));
        else services.generate();
      },
    },
  });
  const three = el('button', {
    class: 'btn tint',
    attributes: { type: 'button' },
    on: {
      click: () => {
        if (store.getState().variations?.making) services.cancel();
        else services.makeVariations();
      },
    },
  });
  const head = el(
    'div',
    { class: 'head' },
    el('h2', { text: 'Reactions', attributes: { id: 'reactions-head' } }),
  );
  const section = el(
    'section',
    { class: 'sec options', attributes: { 'aria-labelledby': 'reactions-head' } },
    head,
  );
  root.append(section);
  const seed = mountSeedBox(head, store, services);
  const cards = mountChoiceCards(section, store, services);
  section.append(
    el('div', { class: 'make' }, make, three),
    el(
      'div',
      { class: 'opts' },
      el('span', { class: 'num' }, el('span', { class: 'lbl', text: 'Steps' }), fewer, count, more),
      el('span', { class: 'grow' }),
      swap,
    ),
  );

  const show = (state: AppState): void => {
    const { settings, manifest } = state;
    for (const control of [fewer, more, swap]) control.disabled = !settings;
    if (settings && manifest) {
      const { min, max } = manifest.diffusion.steps;
      fewer.disabled = settings.steps <= min;
      more.disabled = settings.steps >= max;
      setText(count, String(settings.steps));
    }
    swap.setAttribute('aria-pressed', String(generatedRole(state) === 'leader'));
    swap.title =
      `Your dancer is the ${loadedRole(state)} and the model dances the ${generatedRole(state)}. ` +
      'Press to have it the other way round.';
    make.disabled = !state.leader || !settings || state.job !== null || isReading(state).some(Boolean);
    setText(make, state.reaction ? 'Generate again' : 'Generate');
    make.title = makeWords(state);
    const making = state.variations?.making ?? false;
    const kept = allVariationsMade(state.variations) && state.seedLocked;
    three.disabled = !making && (!state.leader || !settings || isReading(state).some(Boolean) || kept);
    setText(three, making ? 'Cancel' : 'Three reactions');
    three.title = making
      ? 'Make no more'
      : kept
        ? 'Unlock the seed to make three others'
        : 'Make three at once that differ by chance alone, and pick the best';
  };
  return together(
    seed,
    cards,
    watchAll(
      store,
      (state) => [
        state.settings,
        state.manifest,
        state.leader,
        state.song,
        state.reaction,
        state.variations,
        state.seedLocked,
        ...isReading(state),
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
  if (state.job) return 'The reaction is being made.';
  if (state.reading.song) return 'Reading the song';
  if (!upToDate(state)) return state.reaction ? 'The settings have changed since.' : 'Ready.';
  return state.seedLocked
    ? 'Makes the same again: the seed is locked.'
    : 'Another reaction, with a new seed. Changes of the settings are followed by themselves.';
}

function stepper(
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
