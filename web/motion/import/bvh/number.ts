/** Hint for a file with invalid content. */
export const HINT_EXPORT_AGAIN =
  'Export the file again from the program it comes from, or choose another file.';
/** Largest number that is accepted: above it no unit makes sense, and float32 loses the millimetres. */
const MAX_VALUE = 1e7;

/** Why a token is no usable number, as part of a sentence; null when it is one. */
export function numberProblem(token: string | undefined): string | null {
  if (token === undefined || token === '') return 'a number is missing';
  const value = Number(token);
  if (Number.isFinite(value)) return Math.abs(value) < MAX_VALUE ? null : `${token} is too large a number`;
  return `"${token.slice(0, 24)}" is not a number`;
}

/** Hint for a token that is no usable number. */
export function numberHint(token: string | undefined): string {
  return token !== undefined && /^-?\d+,\d+$/.test(token)
    ? 'The numbers use a comma as decimal sign: export with a decimal point.'
    : HINT_EXPORT_AGAIN;
}
