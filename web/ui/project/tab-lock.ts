import { ownName } from '../../common/own-name';

/** The parts of Web Locks and BroadcastChannel that are needed; both are missing on insecure origins. */
export interface TabLockApis {
  /** Of lock and channel, the same for all tabs of the page. */
  readonly name: string;
  readonly locks: Pick<LockManager, 'request'> | undefined;
  readonly channel: Pick<BroadcastChannel, 'postMessage' | 'addEventListener' | 'close'> | undefined;
}

/** What this browser has of them. */
export function tabLockApis(scope: Pick<typeof globalThis, 'navigator' | 'BroadcastChannel'>): TabLockApis {
  const name = ownName('reactdance.project');
  return { name, locks: scope.navigator.locks, channel: openChannel(scope, name) };
}

function openChannel(
  { BroadcastChannel }: Partial<Pick<typeof globalThis, 'BroadcastChannel'>>,
  name: string,
): TabLockApis['channel'] {
  try {
    return BroadcastChannel && new BroadcastChannel(name);
  } catch {
    // Firefox forbids it with all that sites keep.
    return undefined;
  }
}

interface Owner {
  /** This tab has got the right, after it asked for it with `wait` or `takeOver`. */
  readonly gained: () => void;
  /** Another tab has taken it. */
  readonly lost: () => void;
  /** Whether this tab has anything to write; one that has nothing gives way when another one asks. */
  readonly needed: () => boolean;
}

/**
 * The right to write what the browser keeps, which one tab of the page has at a time: a Web Lock, which the browser
 * frees when its tab ends in whatever way. Where there are no Web Locks or the browser forbids them, every tab has it.
 */
export class TabLock {
  private release: (() => void) | null = null;
  private waiting: AbortController | null = null;

  constructor(
    private readonly means: TabLockApis,
    private readonly owner: Owner,
  ) {
    means.channel?.addEventListener('message', () => {
      if (!owner.needed()) this.giveBack();
    });
  }

  get held(): boolean {
    return this.release !== null;
  }

  /** Takes the right if no other tab has it. */
  async takeIfFree(): Promise<void> {
    await this.request({ ifAvailable: true });
  }

  /** Asks the tab that has the right for it, and waits until it ends or gives way. */
  wait(): void {
    if (this.held || this.waiting) return;
    const waiting = new AbortController();
    this.waiting = waiting;
    void this.request({ signal: waiting.signal }).then((held) => {
      if (this.waiting === waiting) this.waiting = null;
      if (held) this.owner.gained();
    });
    this.means.channel?.postMessage('wanted');
  }

  /** Takes the right from the tab that has it. */
  async takeOver(): Promise<void> {
    if (this.held) return;
    this.waiting?.abort();
    this.waiting = null;
    if (await this.request({ steal: true })) this.owner.gained();
  }

  giveBack(): void {
    this.release?.();
    this.release = null;
  }

  dispose(): void {
    this.waiting?.abort();
    this.giveBack();
    this.means.channel?.close();
  }

  /** Resolves with whether the right was got; the lock itself is held until it is given back or taken. */
  private request(options: LockOptions): Promise<boolean> {
    const { name, locks } = this.means;
    const withoutLock = (): true => {
      this.release = () => undefined;
      return true;
    };
    if (!locks) return Promise.resolve(withoutLock());
    return new Promise((resolve) => {
      let release: (() => void) | null = null;
      const held = (lock: Lock | null): Promise<void> | undefined => {
        if (!lock) {
          resolve(false);
          return undefined;
        }
        return new Promise((done) => {
          release = done;
          this.release = done;
          resolve(true);
        });
      };
      locks.request(name, options, held).catch((error: unknown) => {
        // Locks are forbidden with all that sites keep. No other tab keeps anything then, and writing says why.
        if (!(error instanceof DOMException && error.name === 'AbortError')) return resolve(withoutLock());
        // Taken by another tab, or not waited for any longer.
        if (release && this.release === release) {
          this.release = null;
          this.owner.lost();
        }
        resolve(false);
      });
    });
  }
}
