import { differOnlyInWeights, readyInputs, sameInputs } from '../store/selectors';
import type { Inputs, Reaction } from '../store/reaction';
import type { AppState } from '../store/state';
import { apply, type Store } from '../store/store';
import { earlierShown } from '../store/actions/view';

/** How long the earlier dance stays on the stage after the last change, milliseconds. */
const SHOWN_MS = 2000;

/**
 * Keeps the dance before a change of the settings beside the new one for a while, so that one sees what the change did.
 * During a drag of a fader it is the dance from before the drag, and while keys move a fader the one from before the
 * first of them.
 * @returns a function that stops it
 */
export function createEarlierDance(store: Store): () => void {
  let timer: ReturnType<typeof setTimeout> | undefined;
  let seen = store.getState();
  let beforeDrag: Reaction | null = null;
  const show = (earlier: Reaction | null): void => {
    clearTimeout(timer);
    if (earlier) timer = setTimeout(() => show(null), SHOWN_MS);
    if (earlier !== store.getState().earlier) apply(store, earlierShown(earlier));
  };
  const stop = store.subscribe(() => {
    // Not the listener's arguments: another listener may have changed the state once more.
    const [before, now] = [seen, store.getState()];
    seen = now;
    if (now.drag?.held && !before.drag?.held) beforeDrag = now.reaction;
    const inputs = newInputs(before, now);
    const isNew = inputs !== undefined && !sameInputs(before.reaction?.inputs ?? null, inputs);
    if (isNew) show(earlierAfter(before, now, inputs, before.drag && beforeDrag));
  });
  return () => {
    stop();
    clearTimeout(timer);
  };
}

/** What the dance that has just come onto the stage was made from, null without one; undefined where none has come. */
function newInputs(before: AppState, now: AppState): Inputs | null | undefined {
  if (now.preview !== null && now.preview !== before.preview) return readyInputs(now);
  if (now.reaction === before.reaction) return undefined;
  // The dance on view came with its preview already.
  if (before.preview && now.reaction) return undefined;
  return now.reaction?.inputs ?? null;
}

/** The earlier dance beside a dance from these inputs; null where files or roles have changed too. */
function earlierAfter(
  before: AppState,
  now: AppState,
  inputs: Inputs | null,
  beforeDrag: Reaction | null,
): Reaction | null {
  const { reaction: replaced, job } = before;
  if (!replaced || !inputs || now.compare !== 'off' || !sameFiles(replaced.inputs, inputs)) return null;
  // Without a job it was there before, as a take is that is shown again: no further move of a fader.
  const moved = beforeDrag ?? (job && now.earlier);
  return moved && differOnlyInWeights(moved.inputs, inputs) ? moved : replaced;
}

/** Whether all but the settings is the same, and the role too. */
function sameFiles(a: Inputs, b: Inputs): boolean {
  return a.settings.role === b.settings.role && sameInputs({ ...a, settings: b.settings }, b);
}
