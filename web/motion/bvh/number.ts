/** What to do about a file that a program wrote wrongly or a hand broke. */
export const AGAIN = 'Export the file again from the program it comes from, or choose another file.';
/** Beyond this no unit makes sense, and float32 loses the millimetres. */
const LARGEST = 1e7;

/** Why a word of the file is no usable number, or null when it is one. */
export function complaint(token: string | undefined): string | null {
  if (token === undefined || token === '') return 'a number is missing';
  const value = Number(token);
  if (Number.isFinite(value)) return Math.abs(value) < LARGEST ? null : `${token} is too large a number`;
  return /^[+-]?(nan|inf|infinity|1\.#.*)$/i.test(token)
    ? `"${token}" is no finite number`
    : `"${token.slice(0, 24)}" is not a number`;
}

/** What to do about it. */
export function numberHint(token: string | undefined): string {
  return token !== undefined && /^-?\d+,\d+$/.test(token)
    ? 'The numbers use a comma as decimal sign: export with a decimal point.'
    : AGAIN;
}
