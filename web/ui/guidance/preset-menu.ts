import { el, setText } from '../widgets/dom';
import { icon } from '../widgets/icons';
import { type Preset, presetOf, presets } from './presets';
import type { Mount } from '../store/services';
import { presetChosen } from '../store/actions/settings';
import { apply, watch, watchAll } from '../store/store';

const CUSTOM = 'Custom';

/** The menu of presets: a native select, transparent, over the name of the chosen preset. */
export const mountPresetMenu: Mount = (root, store) => {
  let list: Preset[] = [];
  const name = el('span');
  const menu = el('select', {
    attributes: { 'aria-label': 'Guidance preset', disabled: true },
    on: {
      change: () => {
        const preset = list[menu.selectedIndex];
        if (preset) apply(store, presetChosen(preset));
      },
    },
  });
  const box = el('span', { class: 'btn preset' }, name, icon('fold'), menu);
  root.append(box);
  watch(
    store,
    ({ manifest }) => manifest,
    (manifest) => {
      list = manifest ? presets(manifest) : [];
      menu.replaceChildren(...list.map(presetOption), customOption());
    },
  );
  watchAll(
    store,
    ({ manifest, settings }) => [manifest, settings?.guidance, settings?.music, settings?.variety],
    ({ settings }) => {
      menu.disabled = !settings;
      if (!settings) return;
      const chosen = presetOf(list, settings);
      menu.selectedIndex = chosen ? list.indexOf(chosen) : list.length;
      setText(name, chosen?.name ?? CUSTOM);
      menu.title = chosen ? chosen.description : 'Your own mix. Choose a preset to start from.';
    },
  );
};

function presetOption({ name, description }: Preset): HTMLElement {
  return el('option', { text: name, attributes: { title: description } });
}

/** Shown for values that are no preset; it can't be chosen. */
function customOption(): HTMLElement {
  return el('option', { text: CUSTOM, attributes: { disabled: true, hidden: true } });
}
