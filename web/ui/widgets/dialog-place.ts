/** A place for one dialog at a time, which takes the focus and gives it back. */
export interface DialogPlace {
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
  let before: Element | null = null;

  const close = (): void => {
    if (!shown) return;
    const inside = shown.contains(document.activeElement);
    shown.remove();
    shown = null;
    if (inside && before instanceof HTMLElement && before.isConnected) before.focus();
  };
  return {
    show: (dialog, first) => {
      close();
      before = document.activeElement;
      shown = dialog;
      root.append(dialog);
      dialog.querySelector<HTMLElement>(first)?.focus();
    },
    close,
  };
}
