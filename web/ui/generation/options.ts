import { mountVariationCards } from './variation-cards';
import { allVariationsMade } from '../store/actions/variations';
import { loadedRole, generatedRole } from '../store/roles';
import { setDisabled, textButton } from '../widgets/button';
import { el, setText } from '../widgets/dom';
import { icon } from '../widgets/icons';
import { mountHeightBox } from './height-box';
import { mountSeedBox } from './seed-box';
import { isReading, upToDate } from '../store/selectors';
import type { Mount, Services } from '../store/services';
import type { AppState } from '../store/state';
import { rolesSwapped, seedRandomized, randomSeed } from '../store/actions/settings';
import { apply, type Store, watchAll } from '../store/store';

/** One or several controls and how they follow the state. */
interface Controls {
  readonly elements: readonly HTMLElement[];
  readonly show: (state: AppState) => void;
}

/** The section of reactions: seed, variations to pick from, generate, height and swapped roles. */
export const mountOptions: Mount = (root, store, services) => {
  const swap = createSwapButton(store);
  const generate = createGenerateButton(store, services);
  const variations = createVariationsButton(store, services);
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
  mountSeedBox(head, store, services);
  mountVariationCards(section, store, services);
  const row = el('div', { class: 'option-row' });
  mountHeightBox(row, store, services);
  row.append(...swap.elements);
  section.append(el('div', { class: 'make' }, ...generate.elements, ...variations.elements), row);
  watchAll(
    store,
    (state) => [
      state.settings,
      state.leader,
      state.song,
      state.shift,
      state.reaction,
      state.variations,
      state.seedLocked,
      ...isReading(state),
      state.job !== null,
    ],
    (state) => {
      for (const control of [swap, generate, variations]) control.show(state);
    },
  );
};

function createSwapButton(store: Store): Controls {
  const swap = textButton('btn tint swap', 'Swap roles', () => {
    apply(store, rolesSwapped());
  });
  swap.prepend(icon('swap'));
  return {
    elements: [swap],
    show: (state) => {
      swap.disabled = !state.settings;
      swap.setAttribute('aria-pressed', String(generatedRole(state) === 'leader'));
      swap.title =
        `Your dancer is the ${loadedRole(state)} and the model dances the ${generatedRole(state)}. ` +
        'Press to swap the roles.';
    },
  };
}

/** Makes a reaction: another one, with a new seed, when the reaction to the present inputs is on the stage. */
function createGenerateButton(store: Store, services: Services): Controls {
  const button = textButton('btn tint', '', () => {
    const state = store.getState();
    if (upToDate(state) && !state.seedLocked) apply(store, seedRandomized(randomSeed()));
    else services.generate();
  });
  return {
    elements: [button],
    show: (state) => {
      setDisabled(button, !canGenerate(state) || state.job !== null);
      setText(button, state.reaction ? 'Generate again' : 'Generate');
      button.title = generateTitle(state);
    },
  };
}

/** Makes three variations, or cancels them while they are being made. */
function createVariationsButton(store: Store, services: Services): Controls {
  const button = textButton('btn tint', '', ({ detail }) => {
    if (!store.getState().variations?.making) services.makeVariations();
    // The second click of a double click is no wish to stop.
    else if (detail < 2) services.cancel();
  });
  return {
    elements: [button],
    show: (state) => {
      const making = state.variations?.making ?? false;
      setDisabled(button, !making && !canGenerate(state));
      setText(
        button,
        making ? 'Cancel' : allVariationsMade(state.variations) ? 'Three others' : 'Three reactions',
      );
      button.title = making
        ? 'Stop here'
        : 'Makes three reactions that differ as much as possible, with more variety, for you to pick from';
    },
  };
}

/** Whether leader and settings are there and no file is being read. */
function canGenerate(state: AppState): boolean {
  return state.leader !== null && state.settings !== null && !isReading(state).some(Boolean);
}

function generateTitle(state: AppState): string {
  if (!state.leader)
    return state.reading.leader ? 'Reading the leader' : 'Choose a leader first. A song is optional.';
  if (state.job) return 'The reaction is being made.';
  if (state.reading.song) return 'Reading the song';
  if (!upToDate(state)) return state.reaction ? 'The settings have changed since.' : 'Ready.';
  return state.seedLocked
    ? 'The seed is locked, so this makes the same reaction again.'
    : 'Makes another reaction, with a new seed.';
}
