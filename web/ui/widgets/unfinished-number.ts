/**
 * Escape takes back a number that is being typed, and does nothing else on the page then.
 * @param input its default value is the one that holds until typing ends
 */
export function takeBackOnEscape(input: HTMLInputElement): void {
  input.addEventListener('keydown', (event) => {
    const isUnfinished = input.value !== input.defaultValue || input.validity.badInput;
    if (event.key !== 'Escape' || !isUnfinished) return;
    input.value = input.defaultValue;
    event.stopPropagation();
  });
}
