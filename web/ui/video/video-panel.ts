import type {
  Observations,
  People,
  PersonPick,
  ReadReport,
  VideoMotion,
  WorldOptions,
} from '../../video/client';
import { el, rememberFocus, setText } from '../widgets/dom';
import { createMeter } from '../widgets/meter';
import { textButton, closeButton } from '../widgets/button';
import { createControls, type Controls } from './controls';
import { UNSURE } from './video-lane';
import { VideoPicture } from './video-picture';

/** Seconds at the end of a video that are worth a sentence where they cannot be read; of quick videos some pictures are left out. */
const MIN_MISSING = 0.5;

/** What the visitor does on the panel. */
export interface PanelActions {
  /** The video is not wanted: nothing has been read of it. */
  readonly close: () => void;
  /** The panel is to be seen again after it was closed. */
  readonly reopen: () => void;
  /** Whether the stage shows what has been read so far. */
  readonly isPartShown: () => boolean;
  /** What is being read is not wanted. */
  readonly cancel: () => void;
  /** The people of a moment are to be shown, seconds of the video. */
  readonly look: (time: number) => void;
  /** Another person is to be followed. */
  readonly pick: (person: PersonPick) => void;
  readonly change: (options: Partial<WorldOptions>) => void;
  readonly useSound: () => void;
  /** The panel has another size, or is hidden or gone. */
  readonly resized: () => void;
}

/**
 * How much of the stage dancers keep clear of: none where half of it is covered, as on a phone while a person is chosen.
 * There is no room beside that, and the dancers would be shown tiny in what is left.
 * @param right how far the panel reaches from the left of the stage, CSS pixels
 * @param width of the stage, CSS pixels
 */
export function coveredBy(right: number, width: number): number {
  return right < width / 2 ? right : 0;
}

/** The video beside the stage: its picture, progress while it is read, then advice and corrections. */
export class VideoPanel {
  readonly #root: HTMLElement;
  readonly #picture: VideoPicture;
  readonly #status = el('p', { class: 'status' });
  /** Without the progress, which changes several times a second. */
  readonly #spoken = el('p', { class: 'visually-hidden', attributes: { role: 'status' } });
  readonly #meter = createMeter('Reading the video');
  readonly #cancel: HTMLButtonElement;
  readonly #close: HTMLButtonElement;
  readonly #sound: HTMLElement;
  readonly #advice = el('ul', { class: 'notes', attributes: { 'aria-label': 'What to film better' } });
  readonly #controls: Controls;
  readonly #giveBackFocus = rememberFocus();
  #span = { start: 0, end: 0, last: 0 };
  /** When the reading began, milliseconds, and from which moment of the video on. */
  #begun = 0;
  #from = 0;
  #part = 0;
  #hasSound = false;
  #soundUsed = false;
  #hasMotion = false;
  readonly #isPartShown: PanelActions['isPartShown'];
  /** In the place of the panel after it was closed: the dancer stays the leader, and its video is still there. */
  readonly #reopen: HTMLButtonElement;

  constructor(host: HTMLElement, file: File, actions: PanelActions) {
    this.#isPartShown = actions.isPartShown;
    this.#picture = new VideoPicture(file, actions);
    this.#close = closeButton(() => {
      if (this.#hasMotion) this.#fold();
      else actions.close();
    });
    this.#reopen = textButton('btn float video-reopen', 'Show the video', () => {
      actions.reopen();
      this.#close.focus();
    });
    this.#reopen.hidden = true;
    this.#cancel = textButton('btn tint', 'Cancel', actions.cancel);
    this.#sound = textButton('btn tint', 'Use its sound as the song', actions.useSound);
    this.#controls = createControls(actions.change);
    this.#root = el(
      'section',
      { class: 'float video-panel', attributes: { 'aria-label': 'Video of the leader' } },
      el('div', { class: 'head' }, el('h2', { text: file.name }), this.#close),
      // Above the picture, which may reach below the edge of a low window.
      this.#status,
      this.#spoken,
      el('div', { class: 'reading' }, this.#meter.element, this.#cancel),
      this.#advice,
      this.#sound,
      this.#picture.root,
      this.#controls.root,
    );
    host.append(this.#root, this.#reopen);
    new ResizeObserver(actions.resized).observe(this.#root);
    this.showReading();
  }

  showReading(): void {
    this.#reading(true);
    this.#begun = this.#part = 0;
    this.#say('Opening the video');
    this.#meter.show(0);
  }

  showReport(report: Exclude<ReadReport, { kind: 'thumbnail' | 'part' }>): void {
    switch (report.kind) {
      case 'opened':
        this.#span = report;
        this.#hasSound = report.soundStart !== null;
        this.#picture.setVideo(report);
        this.#controls.setSpan(report);
        return;
      case 'networks':
        setText(this.#status, `Loading what finds the dancer, ${Math.round(100 * report.fraction)} %`);
        return;
      case 'persons':
        this.showPeople(report);
        this.#say('Several people: the largest is followed. Click another one to follow them.');
        return;
      case 'picture':
        this.#picture.showRead(report);
        this.#showProgress(report.time);
    }
  }

  /** People of whom one can be picked. */
  showPeople(people: People): void {
    this.#picture.showPeople(people);
  }

  /** How far the reading is. */
  #showProgress(time: number): void {
    const now = performance.now();
    if (this.#begun === 0) [this.#begun, this.#from] = [now, time];
    const { start, end } = this.#span;
    const [read, all] = [time - start, end - start];
    const share = all > 0 ? Math.min(1, read / all) : 0;
    this.#meter.show(share);
    if (this.#picture.choosing) return;
    const pace = (time - this.#from) / ((now - this.#begun) / 1000);
    const left = time - this.#from > 0.02 * all ? (end - time) / pace : null;
    const seen = `${read.toFixed(0)} of ${all.toFixed(0)} s`;
    const progress = left === null ? `Reading, ${seen}` : `Reading, ${seen}, ${timeLeft(left)}`;
    setText(
      this.#status,
      this.#part > 0 && this.#isPartShown()
        ? `${progress}. On the stage: ${this.#part.toFixed(0)} s`
        : progress,
    );
  }

  /** So many seconds of the dance are on the stage already. */
  showPart(seconds: number): void {
    this.#part = seconds;
  }

  /** How much of the stage it covers, from the left, CSS pixels; 0 while it is hidden. */
  get right(): number {
    const { offsetLeft, offsetWidth, parentElement } = this.#root;
    return coveredBy(offsetLeft + offsetWidth, parentElement?.clientWidth ?? 0);
  }

  /** Another video is shown in its place. */
  hide(): void {
    this.#root.hidden = this.#reopen.hidden = true;
    this.#picture.pause();
  }

  #fold(): void {
    this.hide();
    this.#reopen.hidden = false;
    this.#reopen.focus();
  }

  /** The video has been read, and this is what became of it. */
  showMotion(observations: Observations, motion: VideoMotion): void {
    this.#root.hidden = false;
    this.#reopen.hidden = true;
    this.#hasMotion = true;
    this.#reading(false);
    const asked = this.#picture.choosing;
    this.#picture.showObservations(observations);
    // The question had scrolled to its picture, away from what is said now.
    if (asked && !this.#picture.choosing) this.#root.scrollTop = 0;
    this.#controls.setUsed(motion.used);
    this.#controls.setCamera(motion.camera);
    const sure = motion.confidence.reduce((sum, value) => sum + Number(value >= UNSURE), 0);
    const share = Math.round((100 * sure) / Math.max(1, motion.confidence.length));
    this.#say(
      `The dancer is the leader now; ${share} % of the frames are clearly seen.` +
        (this.#hasSound ? '' : ' The video has no sound.'),
    );
    const missing = missingPart(this.#span, observations.times);
    const warnings = missing === null ? motion.advice : [missing, ...motion.advice];
    this.#advice.replaceChildren(...warnings.map((text) => el('li', { text, class: 'warning' })));
  }

  /** Shows how the motion that is shown next was made. */
  showOptions(options: WorldOptions): void {
    this.#controls.setOptions(options);
  }

  /** Whether the page's song is the sound of the video. */
  setSoundUsed(used: boolean): void {
    this.#soundUsed = used;
    if (used) this.#hide(this.#sound);
    else this.#sound.hidden = !this.#hasSound || this.#root.classList.contains('is-reading');
  }

  /** Shows the moment of the dance that is played. @param start moment of the video at which the dance begins */
  showTime(
    playback: { readonly time: number; readonly playing: boolean; readonly speed: number },
    start: number,
  ): void {
    if (!this.#root.hidden) this.#picture.showTime(playback, start);
  }

  dispose(): void {
    this.#picture.dispose();
    this.#giveBackFocus(this.#root);
    this.#root.remove();
    this.#reopen.remove();
  }

  #reading(on: boolean): void {
    this.#root.classList.toggle('is-reading', on);
    this.#meter.element.hidden = !on;
    if (!on) this.#hide(this.#cancel);
    else {
      this.#cancel.hidden = false;
      // What has the focus there goes.
      if (this.#picture.root.contains(document.activeElement)) this.#cancel.focus();
    }
    this.#controls.root.hidden = on;
    this.#sound.hidden = on || !this.#hasSound || this.#soundUsed;
  }

  /** Hides a button; the focus, where the button has it, stays in the panel. */
  #hide(button: HTMLElement): void {
    if (button === document.activeElement) this.#close.focus();
    button.hidden = true;
  }

  #say(text: string): void {
    setText(this.#status, text);
    setText(this.#spoken, text);
  }
}

/** Says that the file names pictures after the last one that could be read; null where it does not. Seconds. */
function missingPart(
  { start, end, last }: { readonly start: number; readonly end: number; readonly last: number },
  times: Float64Array,
): string | null {
  const read = times.at(-1) ?? start;
  if (last - read < MIN_MISSING) return null;
  const seconds = (time: number): string => (time - start).toFixed(1);
  return `The file is incomplete: ${seconds(read)} of ${seconds(end)} s could be read. Copy or download it again.`;
}

function timeLeft(seconds: number): string {
  if (seconds < 60) return `${Math.max(1, Math.round(seconds))} s left`;
  return `${Math.ceil(seconds / 60)} min left`;
}
