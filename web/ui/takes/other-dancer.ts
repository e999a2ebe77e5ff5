import type { SolvedMotion } from '../../motion/clip';
import { reactorMotion } from '../reactor-motion';
import type { Compare, Letter, Take } from '../state';
import { type Store, watchAll } from '../store';
import { opposite, otherTake, takeOnStage, takeTitle } from './take';

/** The reactor of the other take, as it is to be seen at the same playhead. */
export interface OtherDancer {
  readonly motion: SolvedMotion;
  readonly mode: Exclude<Compare, 'off'>;
  /** What the reactor on the stage and this one are called: `A Softer hands`, `B Take 2`. */
  readonly labels: { readonly a: string; readonly b: string };
}

/** A stage that can show a second reactor. */
export interface ComparingStage {
  readonly setOther: (other: OtherDancer | null) => void;
}

/** Keeps the stage's second reactor in step with the comparison. */
export function showOther(store: Store, stage: ComparingStage): () => void {
  const called = (letter: Letter, take: Take | null): string =>
    take ? `${letter} ${takeTitle(take)}` : letter;
  return watchAll(
    store,
    (state) => [state.compare, state.letter, state.footLock, takeOnStage(state), otherTake(state)],
    (state) => {
      const { compare, letter, footLock } = state;
      const other = otherTake(state);
      const motion = reactorMotion({ reaction: other?.reaction ?? null, footLock });
      const labels = { a: called(letter, takeOnStage(state)), b: called(opposite(letter), other) };
      stage.setOther(motion && compare !== 'off' ? { motion, mode: compare, labels } : null);
    },
  );
}
