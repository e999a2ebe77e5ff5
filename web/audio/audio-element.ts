/** One <audio> element that can begin and end without a click. */
export interface Deck {
  readonly element: HTMLAudioElement;
  /** Lets the sound rise from silence when it starts next. */
  readonly fadeIn: () => void;
  /** Lets the sound fall to silence, pauses and calls back. */
  readonly fadeOut: (then: () => void) => void;
}

/** Volumes of a fade, and the time from one to the next in milliseconds: short enough not to be heard as a fade. */
const STEPS = [0.12, 0.35, 0.65, 1] as const;
const STEP = 4;

/** A deck whose element is empty. */
export function createDeck(): Deck {
  const element = new Audio();
  element.preload = 'auto';
  let timer: ReturnType<typeof setTimeout> | undefined;

  const fade = (volumes: readonly number[], then: () => void): void => {
    clearTimeout(timer);
    const [volume, ...rest] = volumes;
    if (volume === undefined) {
      then();
      return;
    }
    element.volume = volume;
    timer = setTimeout(() => {
      fade(rest, then);
    }, STEP);
  };
  return {
    element,
    fadeIn: () => {
      element.volume = 0;
      element.addEventListener('playing', () => fade(STEPS, () => undefined), { once: true });
    },
    fadeOut: (then) => {
      fade([...STEPS].reverse(), () => {
        element.pause();
        element.volume = 1;
        then();
      });
    },
  };
}
