import { textButton, closeButton } from '../../widgets/button';
import { jointSelects } from './joint-selects';
import type { RememberedJointsStorage } from './remembered';
import { importControls } from './import-controls';
import { drawSkeleton } from './skeleton-figure';
import type { Inspection } from '../../../motion/import/inspect';
import type { ImportOptions } from '../../../motion/retarget/options';
import { el, returnFocusOf } from '../../widgets/dom';
import type { Mount } from '../../store/services';
import { panelToggled } from '../../store/actions/view';
import { apply, watch } from '../../store/store';

const FIGURE_SIZE = [260, 340] as const;

/**
 * The panel in which a leader's file is read in another way: which joint is which, shown on a figure, unit, axes, floor,
 * frame rate and clip. It is there too where reading failed.
 */
export function mountImportPanel(remembered: RememberedJointsStorage): Mount {
  return (root, store, services) => {
    const close = closeButton(() => {
      apply(store, panelToggled('import'));
    });
    const content = el('div', { class: 'content' });
    const dialog = el(
      'section',
      { class: 'float import', attributes: { role: 'dialog', 'aria-label': 'Joints and units' } },
      el('div', { class: 'head' }, el('h2', { text: 'Joints and units' }), close),
      content,
    );
    dialog.hidden = true;
    root.append(dialog);
    let opened = 0;
    const returnFocus = returnFocusOf(dialog);
    const open = async (): Promise<void> => {
      const number = ++opened;
      const { refusedLeader, leader } = store.getState();
      const source = refusedLeader ?? leader;
      content.replaceChildren(el('p', { text: source ? 'Reading the joints…' : 'There is no leader yet.' }));
      if (!source) return;
      const inspection = await services.inspectLeader(source).catch(() => null);
      if (number !== opened) return;
      const reread = (options: ImportOptions): void => {
        apply(store, panelToggled('import'));
        services.rereadLeader(source, options);
      };
      content.replaceChildren(...panelContent(inspection, source.options, remembered, reread));
    };
    watch(
      store,
      (state) => state.openPanel === 'import',
      (isOpen) => {
        returnFocus(isOpen);
        dialog.hidden = !isOpen;
        if (!isOpen) return;
        close.focus();
        void open();
      },
    );
    // What is set here is meant for the leader that it was opened for.
    watch(
      store,
      ({ refusedLeader, leader }) => refusedLeader ?? leader,
      (_, { openPanel }) => {
        if (openPanel === 'import') apply(store, panelToggled('import'));
      },
    );
  };
}

/** The figure with its joints, the controls, and what is done with them. */
function panelContent(
  inspection: Inspection | null,
  options: ImportOptions,
  remembered: RememberedJointsStorage,
  reread: (options: ImportOptions) => void,
): HTMLElement[] {
  const controls = importControls(options, inspection);
  const up = options.up ?? inspection?.upAxis ?? 'y';
  const [width, height] = FIGURE_SIZE;
  const canvas = el('canvas', {
    class: 'skeleton',
    attributes: { width, height, role: 'img', 'aria-label': 'The joints that were found, from the front' },
  });
  const selects =
    inspection &&
    jointSelects(inspection, (mapped, marked) => {
      drawSkeleton(canvas, inspection, up, mapped, marked);
    });
  selects?.show();
  const button = (text: string, kind: string, run: () => void): HTMLElement =>
    textButton(`btn ${kind}`, text, run);
  const readAgain = (): void => {
    if (!controls.reportValidity()) return;
    const joints = selects?.changed() ?? options.joints;
    if (inspection && joints) remembered.remember(inspection.skeleton, joints);
    reread({ ...controls.options(), joints });
  };
  const forget = (): void => {
    if (inspection) remembered.remember(inspection.skeleton, null);
    reread({});
  };
  return [
    ...(selects
      ? [el('div', { class: 'mapping' }, canvas, selects.element)]
      : [
          el('p', {
            text: 'No joints can be read in this file; these settings are tried when it is read again.',
          }),
        ]),
    controls.element,
    el(
      'div',
      { class: 'actions' },
      button('Read again', 'primary', readAgain),
      ...(selects ? [button('Exchange left and right', 'ghost', selects.exchangeSides)] : []),
      button('As found', 'ghost', forget),
    ),
  ];
}
