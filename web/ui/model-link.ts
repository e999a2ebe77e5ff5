import type { Generator, Manifest, Status } from '../model/client';
import { rolledSeed } from './options';
import { modelProblem } from './problems';
import type { ModelState } from './state';
import { apply, manifestArrived, modelChanged, told, remarked, type Store } from './store';

export interface ModelLink {
  /** The model when it is ready; rejects when this attempt to load it has failed. */
  readonly generator: () => Promise<Generator>;
  /** The manifest, which comes before the model's bytes; waits through failed attempts. */
  readonly manifest: () => Promise<Manifest>;
  /** Loads again after a failure. */
  readonly retry: () => void;
}

/**
 * Loads the model once for the page and tells the store how that goes.
 * @param create begins to load; told about everything that happens
 */
export function createModelLink(
  store: Store,
  create: (onStatus: (status: Status) => void) => Promise<Generator>,
): ModelLink {
  let tell: (manifest: Manifest) => void = () => undefined;
  const manifest = new Promise<Manifest>((resolve) => {
    tell = resolve;
  });

  const onStatus = (status: Status): void => {
    if (status.kind === 'manifest') {
      if (!store.getState().manifest) apply(store, manifestArrived(status.manifest, rolledSeed()));
      tell(status.manifest);
    } else if (status.kind === 'notice') apply(store, remarked(`${status.message} ${status.hint}`));
    else apply(store, modelChanged(stateOf(status)));
  };
  const load = async (): Promise<Generator> => {
    apply(store, modelChanged({ phase: 'loading', label: 'Model', received: 0, total: 0 }));
    try {
      return await create(onStatus);
    } catch (error) {
      const problem = modelProblem(error);
      apply(store, modelChanged({ phase: 'failed', problem }));
      apply(store, told(problem));
      throw error;
    }
  };
  const begin = (): Promise<Generator> => {
    const loading = load();
    // The failure is told above; who asks for the generator hears of it again.
    loading.catch(() => undefined);
    return loading;
  };

  let current = begin();
  return {
    generator: () => current,
    manifest: () => manifest,
    retry: () => {
      if (store.getState().model.phase === 'failed') current = begin();
    },
  };
}

function stateOf(status: Exclude<Status, { kind: 'manifest' | 'notice' }>): ModelState {
  const preparing = (label: string): ModelState => ({ phase: 'loading', label, received: 0, total: 0 });
  switch (status.kind) {
    case 'download':
      return { phase: 'loading', label: 'Model', received: status.loaded, total: status.total };
    case 'open':
      return preparing('Opening the model');
    case 'check':
    case 'checked':
      return preparing('Checking its numbers');
    case 'warm-up':
      return preparing('Warming up');
    case 'ready': {
      const { name, reason, threads } = status.backend;
      return { phase: 'ready', backend: name, reason, threads };
    }
  }
}
