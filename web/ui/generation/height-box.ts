import { HEIGHTS } from '../../model/client';
import { standingHeight } from '../../motion/skeleton/kinematics';
import { iconButton } from '../widgets/button';
import { el } from '../widgets/dom';
import { finishNumber, showNumber, takeBackOnEscape } from '../widgets/unfinished-number';
import { centimetres } from '../store/format';
import { generatedRole, roleName } from '../store/roles';
import type { Mount } from '../store/services';
import { heightSet } from '../store/actions/settings';
import type { AppState } from '../store/state';
import { apply, watchAll } from '../store/store';

/** The height of the generated dancer in centimetres: typed, or in proportion to the loaded dancer. */
export const mountHeightBox: Mount = (root, store) => {
  const input = el('input', {
    attributes: {
      type: 'number',
      step: 1,
      inputmode: 'numeric',
    },
    on: {
      change: () => {
        if (!Number.isNaN(input.valueAsNumber)) apply(store, heightSet(input.valueAsNumber / 100));
        finishNumber(input);
      },
    },
  });
  takeBackOnEscape(input);
  const reset = iconButton(
    'icon',
    'reset',
    { label: 'Height in proportion', title: 'In proportion to the other dancer' },
    () => {
      apply(store, heightSet(null));
      input.focus();
    },
  );
  const unit = el('span', { class: 'unit', text: 'cm' });
  const box = el(
    'span',
    { class: 'number height' },
    el('span', { class: 'label', text: 'Height', attributes: { 'aria-hidden': true } }),
    input,
    unit,
    reset,
  );
  root.append(box);

  const show = (state: AppState): void => {
    const { settings } = state;
    const set = settings?.height ?? null;
    input.disabled = !settings;
    reset.hidden = set === null;
    const height = set ?? proportionalHeight(state);
    showNumber(input, height === null ? '' : String(centimetres(height)));
    // In proportion to a very small or tall dancer it may be beyond what can be set.
    input.min = String(centimetres(Math.min(HEIGHTS.min, height ?? HEIGHTS.min)));
    input.max = String(centimetres(Math.max(HEIGHTS.max, height ?? HEIGHTS.max)));
    const who = roleName(generatedRole(state));
    input.setAttribute('aria-label', `Height of the ${who.toLowerCase()} in centimetres`);
    input.title =
      `Height of the ${who.toLowerCase()} from the floor to the crown, ` +
      (set === null ? 'in proportion to the other dancer' : 'as you set it');
  };
  watchAll(store, (state) => [state.settings, state.reaction], show);
};

/** The height of the dancer on the stage, if it is in proportion; null while there is none. */
function proportionalHeight({ reaction }: AppState): number | null {
  return reaction && reaction.inputs.settings.height === null
    ? standingHeight(reaction.motion.offsets)
    : null;
}
