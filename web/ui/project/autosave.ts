import { fullProblem } from '../store/problems';
import type { AppState, AutosaveStatus } from '../store/state';
import { apply, type Store } from '../store/store';
import { problemShown } from '../store/actions/notices';
import { currentInputs } from '../store/take';
import { autosaveChanged } from '../store/actions/project';
import { hasVisitorContent, type StoredProject, storedProject } from './schema';
import { isFull, type ProjectStorage } from './storage';

/** Time without a change before the last one is written, so that a drag is written once. */
const DEBOUNCE_MS = 700;
/** Time between two attempts after a failure: space may have been freed in another tab. */
const RETRY_MS = 20_000;

/**
 * Writes songs, leaders, takes and settings to the browser's storage whenever they change, one write after the other,
 * and says in the store whether that works.
 */
export class Autosave {
  private timer: ReturnType<typeof setTimeout> | undefined;
  private unsubscribe = (): void => undefined;
  /** The parts of the state that were written last, or that the timer will write. */
  private seen: readonly unknown[] = [];
  private writing: Promise<void> = Promise.resolve();
  private anythingStored = false;
  /** Whether a write has ever fitted: a full storage is a problem only for who has something to lose. */
  private hasFitted = false;

  constructor(
    private readonly store: Store,
    private readonly storage: ProjectStorage,
  ) {
    globalThis.document?.addEventListener('visibilitychange', this.writeWhenHidden);
  }

  /** What an earlier visit stored; null when there is nothing or the browser gives no storage. */
  async read(): Promise<StoredProject | null> {
    try {
      const stored = await this.storage.read();
      if (stored) this.anythingStored = this.hasFitted = true;
      return stored;
    } catch {
      this.report('refused');
      return null;
    }
  }

  /** Writes the state as it is and every change from now on. */
  start(): void {
    this.write();
    this.unsubscribe = this.store.subscribe((state) => {
      const parts = storedParts(state);
      // The playhead moves all the time: a pending write must not wait for it to stop.
      if (parts.every((part, index) => part === this.seen[index])) return;
      this.seen = parts;
      this.writeAfter(DEBOUNCE_MS);
    });
  }

  dispose(): void {
    clearTimeout(this.timer);
    this.unsubscribe();
    globalThis.document?.removeEventListener('visibilitychange', this.writeWhenHidden);
  }

  private readonly writeWhenHidden = (): void => {
    if (this.timer !== undefined && document.visibilityState === 'hidden') this.write();
  };

  private writeAfter(milliseconds: number): void {
    clearTimeout(this.timer);
    this.timer = setTimeout(() => {
      this.write();
    }, milliseconds);
  }

  /** Queues a write of the state as it is now. */
  private write(): void {
    clearTimeout(this.timer);
    this.timer = undefined;
    const state = this.store.getState();
    this.seen = storedParts(state);
    this.writing = this.writing.then(() => this.save(state));
  }

  private async save(state: AppState): Promise<void> {
    try {
      if (hasVisitorContent(state)) {
        this.anythingStored = true;
        await this.storage.write(storedProject(state));
        this.hasFitted = true;
        this.report('stored');
      } else if (this.anythingStored) {
        await this.storage.clear();
        this.anythingStored = false;
        this.report('stored');
      }
    } catch (error) {
      this.report(isFull(error) ? 'full' : 'refused');
      // Unless a newer change is about to be written anyway.
      if (this.timer === undefined) this.writeAfter(RETRY_MS);
    }
  }

  /** Puts the status into the store; a storage that has become full is also reported as a problem, once. */
  private report(status: AutosaveStatus): void {
    if (this.store.getState().autosave === status) return;
    apply(this.store, autosaveChanged(status));
    if (status === 'full' && this.hasFitted) apply(this.store, problemShown(fullProblem()));
  }
}

/** The parts of the state that are stored; while they are the same, there is nothing to write. */
function storedParts(state: AppState): readonly unknown[] {
  const { takes, reaction, other, letter, compare, footLock, countings, song } = state;
  return [
    takes,
    reaction,
    other,
    letter,
    compare,
    footLock,
    countings,
    song,
    ...Object.values<unknown>({ ...currentInputs(state) }),
  ];
}
