import { readRecipe } from '../../audio/client';
import { randomSeed } from '../store/actions/settings';
import type { Generator, Manifest, ModelFolder, ReloadFailure, Status } from '../../model/client';
import { modelProblem } from '../store/problems';
import type { ModelState } from '../store/state';
import { manifestLoaded, modelChanged, modelOpened } from '../store/actions/model';
import { apply, type Store } from '../store/store';
import { problemShown, noticeAdded } from '../store/actions/notices';

export interface ModelLink {
  /** The model when it is ready; rejects when this attempt to load it has failed. */
  readonly generator: () => Promise<Generator>;
  /** The manifest, which comes before the model's bytes; waits through failed attempts. */
  readonly manifest: () => Promise<Manifest>;
  /** Loads again after a failure. */
  readonly retry: () => void;
  /** Replaces the model by the visitor's own; false when that fails, which is reported, and the present one stays. */
  readonly open: (folder: ModelFolder) => Promise<boolean>;
}

/**
 * Loads the page's model, or one that the visitor opens, with its progress in the store.
 * @param create loads a model, from a folder or from the page's own address, and reports each status
 */
export function createModelLink(
  store: Store,
  create: (
    onStatus: (status: Status | ReloadFailure) => void,
    folder: ModelFolder | null,
  ) => Promise<Generator>,
): ModelLink {
  let resolveManifest: (manifest: Manifest) => void = () => undefined;
  const manifest = new Promise<Manifest>((resolve) => {
    resolveManifest = resolve;
  });

  const fail = (error: unknown): void => {
    const problem = modelProblem(error);
    apply(store, modelChanged({ phase: 'failed', problem }));
    apply(store, problemShown(problem));
  };
  const onStatus = (status: Status | ReloadFailure): void => {
    if (status.kind === 'failed') fail(status.error);
    else if (status.kind === 'manifest') {
      if (!store.getState().manifest) apply(store, manifestLoaded(status.manifest, randomSeed()));
      resolveManifest(status.manifest);
    } else if (status.kind === 'notice') apply(store, noticeAdded(`${status.message} ${status.hint}`));
    else apply(store, modelChanged(stateOf(status)));
  };
  const load = async (): Promise<Generator> => {
    apply(store, modelChanged({ phase: 'loading', label: 'Finding the model', received: 0, total: 0 }));
    // Other downloads may still report progress after one has failed.
    let failed = false;
    try {
      return await usable(
        create((status) => {
          if (!failed) onStatus(status);
        }, null),
      );
    } catch (error) {
      failed = true;
      fail(error);
      throw error;
    }
  };
  const begin = (): Promise<Generator> => {
    const loading = load();
    // The failure is reported above, and again to each caller of `generator`.
    loading.catch(() => undefined);
    return loading;
  };

  let current = begin();
  return {
    generator: () => current,
    manifest: () => Promise.resolve(store.getState().manifest ?? manifest),
    retry: () => {
      if (store.getState().model.phase === 'failed') current = begin();
    },
    open: async (folder) => {
      const before = current;
      const shown = store.getState().model;
      try {
        // The present model's manifest stays until the other one is ready.
        const made = await usable(create((status) => status.kind !== 'manifest' && onStatus(status), folder));
        current = Promise.resolve(made);
        apply(store, modelOpened(made.manifest, randomSeed()));
        resolveManifest(made.manifest);
        before.then(
          (old) => old.dispose(),
          () => undefined,
        );
        return true;
      } catch (error) {
        apply(store, modelChanged(shown));
        apply(store, problemShown(modelProblem(error)));
        return false;
      }
    },
  };
}

/** A model by whose recipe the page can analyse songs. @throws {AppError} bad-recipe, or why there is no model */
async function usable(creating: Promise<Generator>): Promise<Generator> {
  const made = await creating;
  try {
    readRecipe(made.manifest.audio);
    return made;
  } catch (error) {
    made.dispose();
    throw error;
  }
}

function stateOf(status: Exclude<Status, { kind: 'manifest' | 'notice' }>): ModelState {
  const preparing = (label: string): ModelState => ({ phase: 'loading', label, received: 0, total: 0 });
  switch (status.kind) {
    case 'download':
      return {
        phase: 'loading',
        label: 'Model',
        received: status.parts.reduce((sum, part) => sum + part.loaded, 0),
        total: status.parts.reduce((sum, part) => sum + part.total, 0),
        parts: status.parts,
      };
    case 'open':
      return preparing('Opening the model');
    case 'check':
    case 'checked':
      return preparing('Checking the model');
    case 'warm-up':
      return preparing('Warming up');
    case 'ready': {
      const { name, reason, threads } = status.backend;
      return { phase: 'ready', backend: name, reason, threads };
    }
  }
}
