/** A seed that nobody chose: small enough to read out and to type again. */
export function rolledSeed(): number {
  return 1 + Math.floor(Math.random() * 9999);
}
