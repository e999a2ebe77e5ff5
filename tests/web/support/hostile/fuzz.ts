import { expect } from 'vitest';
import { AppError } from '../../../../web/common/error';
import { processorTimer } from '../processor-time';
import { FUZZ_CASES, MAX_CASE_SECONDS, type Random, randomOf } from './mutations';

/** How the cases of a reader ended. */
interface Outcome {
  readonly read: number;
  readonly refused: number;
}

/**
 * Gives a reader damaged files. Every case must end in time, in an AppError with message and hint or in a value that
 * `meaningful` accepts.
 */
export function fuzz<Input, Value>(
  damage: (random: Random) => Input,
  read: (input: Input) => Value,
  meaningful: (value: Value) => void,
): Outcome {
  let refused = 0;
  const wrong: string[] = [];
  for (let seed = 0; seed < FUZZ_CASES; seed++) {
    const input = damage(randomOf(seed));
    const seconds = processorTimer();
    try {
      meaningful(read(input));
    } catch (error) {
      if (error instanceof AppError && error.message !== '' && error.hint !== '') refused++;
      else wrong.push(`case ${seed}: ${error instanceof Error ? error.stack?.slice(0, 400) : String(error)}`);
    }
    const took = seconds();
    if (took > MAX_CASE_SECONDS) wrong.push(`case ${seed} took ${took.toFixed(1)} s`);
  }
  expect(wrong.slice(0, 5), `${wrong.length} of ${FUZZ_CASES} cases`).toEqual([]);
  return { read: FUZZ_CASES - refused, refused };
}
