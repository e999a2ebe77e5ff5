import type { SolvedMotion } from '../../motion/skeleton/clip';
import { reactorMotion } from '../store/reactor-motion';
import type { Take } from '../store/reaction';
import type { Letter } from '../store/state';
import { watchAll, type Watched } from '../store/store';
import { otherTake, takeOnStage, takeTitle } from '../store/take';

/** The reactor of the other take, drawn at the same playhead. */
export interface OtherDancer {
  readonly motion: SolvedMotion;
  /** As a ghost in the same picture, or in one half of a split picture: A is always on the left. */
  readonly mode: 'ghost' | 'left' | 'right';
  /** Labels of the two halves: `A Softer hands`, `B Take 2`. */
  readonly labels: { readonly left: string; readonly right: string };
}

/** A stage that can show a second reactor. */
interface ComparingStage {
  readonly setOther: (other: OtherDancer | null) => void;
}

/** Shows the other take on the stage while two takes are compared; returns a function that stops it. */
export function showOther(store: Watched, stage: ComparingStage): () => void {
  const labelOf = (letter: Letter, take: Take | null): string =>
    take ? `${letter} ${takeTitle(take)}` : letter;
  return watchAll(
    store,
    (state) => [state.compare, state.letter, state.footLock, takeOnStage(state), otherTake(state)],
    (state) => {
      const { compare, letter, footLock } = state;
      const other = otherTake(state);
      const motion = reactorMotion({ reaction: other?.reaction ?? null, footLock });
      if (!motion || compare === 'off') {
        stage.setOther(null);
        return;
      }
      const [a, b] = letter === 'A' ? [takeOnStage(state), other] : [other, takeOnStage(state)];
      const labels = { left: labelOf('A', a), right: labelOf('B', b) };
      stage.setOther({
        motion,
        mode: compare === 'ghost' ? 'ghost' : letter === 'A' ? 'right' : 'left',
        labels,
      });
    },
  );
}
