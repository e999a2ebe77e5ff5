import { FadingAudio } from './audio-element';

/** One song in two <audio> elements: the active one plays, the idle one waits at the start of the loop. */
export class AudioElementPair {
  #active = new FadingAudio();
  #idle = new FadingAudio();
  /** Object URL of the song. */
  #source: string | null = null;

  get active(): HTMLAudioElement {
    return this.#active.element;
  }

  get idle(): HTMLAudioElement {
    return this.#idle.element;
  }

  get both(): readonly HTMLAudioElement[] {
    return [this.active, this.idle];
  }

  get hasSource(): boolean {
    return this.#source !== null;
  }

  /** @param sound a sound file, null for silence */
  setSource(sound: Blob | null): void {
    this.pause();
    if (this.#source !== null) URL.revokeObjectURL(this.#source);
    this.#source = sound && URL.createObjectURL(sound);
    for (const element of this.both) {
      if (this.#source === null) element.removeAttribute('src');
      else element.src = this.#source;
      element.load();
    }
  }

  /** Sets the speed; loading an element resets it to the default one, so both are set. */
  setSpeed(speed: number): void {
    for (const element of this.both) {
      element.defaultPlaybackRate = speed;
      element.playbackRate = speed;
    }
  }

  pause(): void {
    for (const element of this.both) element.pause();
  }

  /** Crossfades to the idle element: it becomes the active one. `onSilent` is called when the other one has stopped. */
  swap(onSilent: () => void): void {
    [this.#active, this.#idle] = [this.#idle, this.#active];
    this.#active.fadeIn();
    this.#idle.fadeOut(onSilent);
  }
}
