import { modelFolder } from './dropped';
import type { DroppedFile, Files } from '../store/services';
import type { ModelLink } from './model-link';
import { dropProblem, emptyDropProblem } from '../store/problems';
import { apply, type Store } from '../store/store';
import { problemShown } from '../store/actions/notices';

/**
 * Opens what was dropped: the folder of a model, or songs and leaders. What can't be read is told.
 * @param generate makes a reaction with the model that was opened
 */
export async function openDropped(
  coming: Promise<readonly DroppedFile[]>,
  store: Store,
  files: Pick<Files, 'open'>,
  model: Pick<ModelLink, 'open'>,
  generate: () => void,
): Promise<void> {
  let dropped: readonly DroppedFile[];
  try {
    dropped = await coming;
  } catch (error) {
    apply(store, problemShown(dropProblem(error)));
    return;
  }
  const folder = modelFolder(dropped);
  if (dropped.length === 0) apply(store, problemShown(emptyDropProblem()));
  else if (!folder) await files.open(dropped.map(({ file }) => file));
  else if (await model.open(folder)) generate();
}
