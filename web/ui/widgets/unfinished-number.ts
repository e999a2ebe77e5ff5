/**
 * Shows a number that holds until typing ends. What is being typed stays, whatever else changes on the page meanwhile.
 * @param text empty for none
 */
export function showNumber(input: HTMLInputElement, text: string): void {
  const typing = isUnfinished(input);
  input.defaultValue = text;
  if (!typing) input.value = text;
}

/** Typing has ended: shows the number that holds. */
export function finishNumber(input: HTMLInputElement): void {
  input.value = input.defaultValue;
}

/** Escape takes back a number that is being typed, and does nothing else on the page then. */
export function takeBackOnEscape(input: HTMLInputElement): void {
  input.addEventListener('keydown', (event) => {
    if (event.key !== 'Escape' || !isUnfinished(input)) return;
    finishNumber(input);
    event.stopPropagation();
  });
}

/** Whether a number is being typed. */
export function isUnfinished(input: HTMLInputElement): boolean {
  return input.value !== input.defaultValue || input.validity.badInput;
}
