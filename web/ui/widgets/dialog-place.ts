import { rememberFocus } from './dom';

/** A place for one dialog at a time, which takes the focus and gives it back. */
interface DialogPlace {
  /**
   * Shows a dialog in the place of the one that is shown.
   * @param first selector of what gets the focus
   */
  readonly show: (dialog: HTMLElement, first: string) => void;
  /** Removes the dialog; the focus, where it is inside, goes back to where it was before. */
  readonly close: () => void;
}

/** @param root element that dialogs are shown in */
export function createDialogPlace(root: HTMLElement): DialogPlace {
  let shown: HTMLElement | null = null;
  let giveBackFocus = rememberFocus();

  const close = (): void => {
    if (!shown) return;
    giveBackFocus(shown);
    shown.remove();
    shown = null;
  };
  return {
    show: (dialog, first) => {
      close();
      giveBackFocus = rememberFocus();
      shown = dialog;
      root.append(dialog);
      dialog.querySelector<HTMLElement>(first)?.focus();
    },
    close,
  };
}
