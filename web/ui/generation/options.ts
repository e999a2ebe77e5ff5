import { mountVariationCards } from './variation-cards';
import { allVariationsMade } from '../store/actions/variations';
import { loadedRole, generatedRole } from '../store/roles';
import { iconButton, textButton } from '../widgets/button';
import { el, setText, combineDisposers } from '../widgets/dom';
import { mountHeightBox } from './height-box';
import { mountSeedBox } from './seed-box';
import { isReading, upToDate } from '../store/selectors';
import type { Mount, Services } from '../store/services';
import type { AppState } from '../store/state';
import { rolesSwapped, seedRandomized, stepsSet, randomSeed } from '../store/actions/settings';
import { apply, type Store, watchAll } from '../store/store';

/** One or several controls and how they follow the state. */
interface Controls {
  readonly elements: readonly HTMLElement[];
  readonly show: (state: AppState) => void;
}

/** The section of reactions: seed, variations to pick from, generate, number of steps, height and swapped roles. */
export const mountOptions: Mount = (root, store, services) => {
  const steps = createStepControl(store);
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
  const seed = mountSeedBox(head, store, services);
  const cards = mountVariationCards(section, store, services);
  const row = el('div', { class: 'option-row' }, ...steps.elements);
  const height = mountHeightBox(row, store, services);
  row.append(...swap.elements);
  section.append(el('div', { class: 'make' }, ...generate.elements, ...variations.elements), row);
  return combineDisposers(
    seed,
    cards,
    height,
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
      (state) => {
        for (const control of [steps, swap, generate, variations]) control.show(state);
      },
    ),
    () => {
      section.remove();
    },
  );
};

/** The number of diffusion steps with a button for fewer and one for more. */
function createStepControl(store: Store): Controls {
  const count = el('output', { attributes: { 'aria-label': 'Steps' } });
  const changeBy = (by: number) => (): void => {
    apply(store, stepsSet((store.getState().settings?.steps ?? 0) + by));
  };
  const fewer = iconButton(
    'icon',
    'minus',
    { label: 'Fewer steps', title: 'Fewer steps: quicker, rougher' },
    changeBy(-1),
  );
  const more = iconButton(
    'icon',
    'plus',
    { label: 'More steps', title: 'More steps: slower, smoother' },
    changeBy(1),
  );
  const label = el('span', { class: 'label', text: 'Steps' });
  return {
    elements: [el('span', { class: 'number' }, label, fewer, count, more)],
    show: ({ settings, manifest }) => {
      fewer.disabled = more.disabled = !settings;
      if (!settings || !manifest) return;
      const { min, max } = manifest.diffusion.steps;
      fewer.disabled = settings.steps <= min;
      more.disabled = settings.steps >= max;
      setText(count, String(settings.steps));
    },
  };
}

function createSwapButton(store: Store): Controls {
  const swap = iconButton('btn tint swap', 'swap', { label: 'Swap roles' }, () => {
    apply(store, rolesSwapped());
  });
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
      button.disabled = !canGenerate(state) || state.job !== null;
      setText(button, state.reaction ? 'Generate again' : 'Generate');
      button.title = generateTitle(state);
    },
  };
}

/** Makes three variations, or cancels them while they are being made. */
function createVariationsButton(store: Store, services: Services): Controls {
  const button = textButton('btn tint', '', () => {
    if (store.getState().variations?.making) services.cancel();
    else services.makeVariations();
  });
  return {
    elements: [button],
    show: (state) => {
      const making = state.variations?.making ?? false;
      button.disabled = !making && !canGenerate(state);
      setText(
        button,
        making ? 'Cancel' : allVariationsMade(state.variations) ? 'Three others' : 'Three reactions',
      );
      button.title = making
        ? 'Stop here'
        : 'Makes three reactions that differ as much as possible, for you to pick from';
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
