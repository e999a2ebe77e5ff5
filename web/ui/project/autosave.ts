import { isFull, isNewer } from './database';
import type { Framing } from '../../common/framing';
import { yieldToPage } from '../../common/yield-to-events';
import { fullProblem } from '../store/problems';
import type { Take } from '../store/reaction';
import type { AppState, AutosaveStatus } from '../store/state';
import { apply, type Store } from '../store/store';
import { problemShown } from '../store/actions/notices';
import { currentInputs } from '../store/take';
import { autosaveChanged } from '../store/actions/project';
import { TabLock, type TabLockApis } from './tab-lock';
import type { FoundProject } from './records';
import { hasVisitorContent, storedProject } from './stored-project';
import { type ProjectStorage } from './storage';

/** Time between two attempts after a failure: space may have been freed in another tab. */
const RETRY_MS = 20_000;
/** Time in which a tab that has nothing to write gives way to this one. */
const GIVE_WAY_MS = 500;

interface Callbacks {
  /**
   * Puts on the page what another tab has written while this one could not write.
   * @param synced the takes as this tab last read or wrote them
   */
  readonly merge: (synced: readonly Take[]) => Promise<void>;
  /** How the camera sees the couple now; null without a stage. */
  readonly framing: () => Framing | null;
  /** A take that was made in this visit is stored. */
  readonly takeStored: () => void;
}

/**
 * Writes songs, leaders, takes and settings to the browser's storage as soon as they change, and says in the store
 * whether that works. While one change is being written, the newest one waits. Of several tabs one writes.
 */
export class Autosave {
  private timer: ReturnType<typeof setTimeout> | undefined;
  private unsubscribe = (): void => undefined;
  private readonly lock: TabLock;
  /** The parts of the state that were written last, or are being written. */
  private seen: readonly unknown[] = [];
  private synced: readonly Take[] = [];
  private busy = false;
  /** There is a newer change than the one that is being written. */
  private changed = false;
  private anythingStored = false;
  /** The visitor has emptied the page, and with it the storage; else what could not be restored stays there. */
  private cleared = false;
  /** Whether a write has ever fitted: a full storage is a problem only for who has something to lose. */
  private hasFitted = false;
  /** Before the page is restored, and where a newer page has written the storage, nothing is written. */
  private mayWrite = false;

  constructor(
    private readonly store: Store,
    private readonly storage: ProjectStorage,
    tabs: TabLockApis,
    private readonly callbacks: Callbacks,
  ) {
    this.lock = new TabLock(tabs, {
      gained: () => void this.goOn(),
      lost: this.wait,
      needed: () => this.anythingStored || hasVisitorContent(store.getState()),
    });
    globalThis.document?.addEventListener('visibilitychange', this.writeWhenHidden);
  }

  /** What an earlier visit stored, unchecked; null when there is nothing or the browser gives no storage. */
  async read(): Promise<FoundProject | null> {
    try {
      await this.lock.takeIfFree();
      const found = await this.storage.read();
      if (found) {
        this.anythingStored = this.hasFitted = true;
        // Restoring may take seconds; who reads meanwhile that the work is open elsewhere changes nothing in vain.
        if (!this.lock.held) this.sayElsewhere();
      }
      return found;
    } catch (error) {
      this.report(isNewer(error) ? 'newer' : 'refused');
      return null;
    }
  }

  /** Writes the state as it is and every change from now on. */
  start(): void {
    if (this.store.getState().autosave === 'newer') return;
    this.mayWrite = true;
    this.noteSynced();
    this.write();
    this.unsubscribe = this.store.subscribe((state) => {
      const parts = storedParts(state);
      // Playhead and camera move all the time; they are written with what else changes, and when the page is left.
      if (!parts.every((part, index) => part === this.seen[index])) this.write();
    });
  }

  /** Empties the storage of everything once the page is empty, also of what could not be restored. */
  clear(): void {
    this.cleared = true;
  }

  /** The takes on the page are those that are stored. */
  noteSynced(): void {
    this.synced = this.store.getState().takes;
  }

  /** Writes from here, no longer from the tab that does. */
  takeOver(): Promise<void> {
    return this.lock.takeOver();
  }

  dispose(): void {
    clearTimeout(this.timer);
    this.unsubscribe();
    this.lock.dispose();
    globalThis.document?.removeEventListener('visibilitychange', this.writeWhenHidden);
  }

  private readonly writeWhenHidden = (): void => {
    if (document.visibilityState === 'hidden') this.write(true);
  };

  /**
   * Writes the state as it is now, or as it is once the write that is under way has ended.
   * @param leaving the page may end with this task
   */
  private write(leaving = false): void {
    if (!this.mayWrite) return;
    const state = this.store.getState();
    this.seen = storedParts(state);
    if (!this.lock.held) {
      if (hasVisitorContent(state)) this.wait();
    } else if (this.busy) this.changed = true;
    else void this.save(leaving);
  }

  private async save(leaving: boolean): Promise<void> {
    clearTimeout(this.timer);
    this.busy = true;
    do {
      // In a task of its own: to store a long dance takes as long as to show it.
      if (!leaving) await yieldToPage();
      this.changed = false;
      await this.saveNow(this.store.getState());
    } while (this.changed && this.lock.held);
    this.busy = false;
  }

  private async saveNow(state: AppState): Promise<void> {
    try {
      if (hasVisitorContent(state)) {
        this.anythingStored = true;
        // It is set again if the visitor starts afresh while this is being written.
        this.cleared = false;
        await this.storage.write(storedProject(state, this.callbacks.framing()));
        this.hasFitted = true;
        const isNew = ({ id, reaction }: Take): boolean =>
          reaction.label === null && !this.synced.some((take) => take.id === id);
        if (state.takes.some(isNew)) this.callbacks.takeStored();
      } else if (this.anythingStored) {
        await (this.cleared ? this.storage.clear() : this.storage.removeOwn());
        this.cleared = false;
        this.anythingStored = false;
      } else return;
      this.synced = state.takes;
      this.report('stored');
    } catch (error) {
      if (isNewer(error)) {
        this.mayWrite = false;
        this.report('newer');
        return;
      }
      this.report(isFull(error) ? 'full' : 'refused');
      this.timer = setTimeout(() => this.write(), RETRY_MS);
    }
  }

  /** Waits for the right to write; says so unless the tab that has it gives way at once. */
  private readonly wait = (): void => {
    this.lock.wait();
    this.sayElsewhere();
  };

  private sayElsewhere(): void {
    clearTimeout(this.timer);
    this.timer = setTimeout(() => {
      if (!this.lock.held) this.report('elsewhere');
    }, GIVE_WAY_MS);
  }

  /** This tab has got the right to write after another one had it. */
  private async goOn(): Promise<void> {
    clearTimeout(this.timer);
    await this.callbacks.merge(this.synced).catch(() => undefined);
    if (this.store.getState().autosave === 'elsewhere') this.report('stored');
    this.write();
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
  const { takes, reaction, other, letter, compare, footLock, countings, song, playback } = state;
  return [
    takes,
    reaction,
    other,
    letter,
    compare,
    footLock,
    countings,
    song,
    playback.region,
    playback.loop,
    ...Object.values<unknown>({ ...currentInputs(state) }),
  ];
}
