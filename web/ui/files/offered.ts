import { fetchShipped } from '../../common/fetch';
import { readingSet } from '../store/actions/files';
import { problemShown } from '../store/actions/notices';
import { offeredProblem } from '../store/problems';
import type { Files } from '../store/services';
import { ask } from '../store/history/asked';
import { apply, type Store } from '../store/store';

/** A leader that ships with the page: its file in leaders/, and what it is called. */
interface OfferedLeader {
  readonly file: string;
  readonly name: string;
}

/** Leaders that can be chosen without a file of one's own; `export/leaders/` composes the dances. */
export const OFFERED_LEADERS: readonly OfferedLeader[] = [
  { file: 'slow.bvh', name: 'Slow' },
  { file: 'quick.bvh', name: 'Quick' },
  { file: 'turning.bvh', name: 'Turning' },
  { file: 'playful.bvh', name: 'Playful' },
  { file: 'sample.webm', name: 'A sample video' },
];

/** Opens leaders that ship with the page, as if the visitor had given their files. */
export class OfferedLeaders {
  /** Ends the download of the one that was asked for last; null while there is none. */
  #loading: AbortController | null = null;

  /** @param folder where their files are */
  constructor(
    private readonly store: Store,
    private readonly files: Pick<Files, 'open' | 'cancel'>,
    private readonly folder: URL,
  ) {}

  /** @param file its name in the folder */
  async open(file: string): Promise<void> {
    // Also a file that is still being read.
    this.files.cancel('leader');
    const { signal } = (this.#loading = new AbortController());
    const { name } = OFFERED_LEADERS.find((one) => one.file === file)!;
    signal.addEventListener('abort', ask(this.store, 'leader'));
    apply(this.store, readingSet('leader', { name, fraction: 0 }));
    let content: Blob;
    try {
      content = await (await fetchShipped(new URL(file, this.folder), signal)).blob();
      if (signal.aborted) return;
    } catch {
      if (signal.aborted) return;
      this.cancel();
      apply(this.store, problemShown(offeredProblem(name)));
      return;
    }
    this.cancel();
    const ending = file.replace(/^[^.]*/, '');
    const type = ending === '.webm' ? 'video/webm' : '';
    await this.files.open([new File([content], `${name.replace(/^A /, '')}${ending}`, { type })]);
  }

  /** A newer leader has been asked for: one that is still being downloaded is not to take its place. */
  cancel(): void {
    if (!this.#loading) return;
    this.#loading.abort();
    this.#loading = null;
    apply(this.store, readingSet('leader', null));
  }
}
