import { readRecipe } from '../../audio/client';
import { randomSeed } from '../store/actions/settings';
import type { Generator, Manifest, ModelFolder, ReloadFailure, Status } from '../../model/client';
import { modelProblem, ownModelProblem } from '../store/problems';
import type { ModelState } from '../store/state';
import { manifestLoaded, modelChanged, modelOpened } from '../store/actions/model';
import { apply, type Store } from '../store/store';
import { noticeAdded, problemClosed, problemShown } from '../store/actions/notices';

/** Loads a model, from a folder or from the page's own address, and reports each status. */
type Create = (
  onStatus: (status: Status | ReloadFailure) => void,
  folder: ModelFolder | null,
) => Promise<Generator>;

/** One attempt to load a model, and what it has come to. */
interface Load {
  /** The visitor's own model; null for the page's. */
  readonly folder: ModelFolder | null;
  state: ModelState;
}

function newLoad(folder: ModelFolder | null): Load {
  return { folder, state: { phase: 'loading', label: 'Finding the model', received: 0, total: 0 } };
}

/** Loads the page's model, or one that the visitor opens, with its progress in the store. */
export class ModelLink {
  #current = newLoad(null);
  /** The visitor's own model that is to replace the current one; its progress is shown meanwhile. */
  #opening: Load | null = null;
  /** The visitor's own model that failed to open last. */
  #refused: ModelFolder | null = null;
  #generator: Promise<Generator>;
  #resolveManifest: (manifest: Manifest) => void = () => undefined;
  readonly #manifest = new Promise<Manifest>((resolve) => {
    this.#resolveManifest = resolve;
  });

  constructor(
    private readonly store: Store,
    private readonly create: Create,
  ) {
    this.#generator = this.#begin(null);
  }

  /** The model when it is ready; rejects when this attempt to load it has failed. */
  readonly generator = (): Promise<Generator> => this.#generator;

  /** The manifest, which comes before the model's bytes; waits through failed attempts. */
  readonly manifest = (): Promise<Manifest> =>
    Promise.resolve(this.store.getState().manifest ?? this.#manifest);

  /** Loads the same model again after a failure; false where there was none. */
  readonly retry = (): boolean => {
    const { model, problem } = this.store.getState();
    if (model.phase !== 'failed') return false;
    if (problem?.remedy === 'model') apply(this.store, problemClosed());
    this.#generator = this.#begin(this.#current.folder);
    return true;
  };

  /**
   * Replaces the model by the visitor's own; false when that fails, which is reported, or when another one is opened
   * meanwhile: the present one stays.
   */
  async open(folder: ModelFolder): Promise<boolean> {
    const load = (this.#opening = newLoad(folder));
    let made: Generator;
    try {
      made = await this.#run(load);
    } catch (error) {
      if (load !== this.#opening) return false;
      this.#opening = null;
      this.#refused = folder;
      this.#show();
      apply(this.store, problemShown(ownModelProblem(error)));
      return false;
    }
    if (load !== this.#opening) {
      made.dispose();
      return false;
    }
    const before = this.#generator;
    this.#generator = Promise.resolve(made);
    this.#current = load;
    this.#opening = null;
    apply(this.store, modelOpened(made.manifest, randomSeed()));
    this.#resolveManifest(made.manifest);
    before.then(
      (old) => old.dispose(),
      () => undefined,
    );
    return true;
  }

  /** Opens the visitor's own model again that failed to open; as `open`. */
  readonly reopen = async (): Promise<boolean> => this.#refused !== null && this.open(this.#refused);

  #begin(folder: ModelFolder | null): Promise<Generator> {
    this.#current = newLoad(folder);
    const loading = this.#run(this.#current);
    // The failure is reported by `#run`, and again to each caller of `generator`.
    loading.catch(() => undefined);
    return loading;
  }

  async #run(load: Load): Promise<Generator> {
    // Other downloads may still report progress after one has failed.
    let failed = false;
    this.#show();
    try {
      const onStatus = (status: Status | ReloadFailure): void => {
        if (!failed) this.#onStatus(load, status);
      };
      return await usable(this.create(onStatus, load.folder));
    } catch (error) {
      failed = true;
      this.#fail(load, error);
      // Its callers are not told of a failure that is not shown.
      if (this.#opening && load !== this.#opening)
        throw new DOMException('Another model is opened.', 'AbortError');
      throw error;
    }
  }

  #onStatus(load: Load, status: Status | ReloadFailure): void {
    // A model that has been replaced may still be loading.
    if (load !== this.#current && load !== this.#opening) return;
    if (status.kind === 'failed') this.#fail(load, status.error);
    else if (status.kind === 'manifest') {
      // The present model's manifest stays until the other one is ready.
      if (load === this.#opening) return;
      if (!this.store.getState().manifest) apply(this.store, manifestLoaded(status.manifest, randomSeed()));
      this.#resolveManifest(status.manifest);
    } else if (status.kind === 'notice') apply(this.store, noticeAdded(`${status.message} ${status.hint}`));
    else {
      load.state = stateOf(status);
      this.#show();
    }
  }

  #fail(load: Load, error: unknown): void {
    if (load !== this.#current) return;
    const problem = modelProblem(error);
    load.state = { phase: 'failed', problem };
    if (this.#opening) return;
    this.#show();
    apply(this.store, problemShown(problem));
  }

  #show(): void {
    apply(this.store, modelChanged((this.#opening ?? this.#current).state));
  }
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
      const { name, reason } = status.backend;
      return { phase: 'ready', backend: name, reason };
    }
  }
}
