import { recipe } from './audio-fixtures';

const rate = recipe.sample_rate;

/** A sequence of the same pseudo-random numbers each time, 0 to 1 (mulberry32). */
export function randomNumbers(seed: number): () => number {
  let state = seed;
  return () => {
    state = (state + 0x6d2b79f5) | 0;
    let mixed = Math.imul(state ^ (state >>> 15), 1 | state);
    mixed = (mixed + Math.imul(mixed ^ (mixed >>> 7), 61 | mixed)) ^ mixed;
    return ((mixed ^ (mixed >>> 14)) >>> 0) / 2 ** 32;
  };
}

/** Mono samples at the recipe's rate: a bed of faint noise, as recordings have. */
export function quiet(seconds: number): Float32Array {
  const random = randomNumbers(1);
  return Float32Array.from({ length: seconds * rate }, () => 2e-3 * (random() - 0.5));
}

function add(song: Float32Array, second: number, length: number, sound: (time: number) => number): void {
  const start = Math.round(second * rate);
  const end = Math.min(song.length, start + Math.round(length * rate));
  for (let i = Math.max(0, start); i < end; i++) song[i]! += sound((i - start) / rate);
}

/** A stroke of noise. */
export function stroke(song: Float32Array, second: number, level: number, decay = 40): void {
  const random = randomNumbers(Math.round(second * 1000));
  add(song, second, 0.15, (time) => level * (2 * random() - 1) * Math.exp(-decay * time));
}

/** A bass drum. */
export function kick(song: Float32Array, second: number, level: number): void {
  add(song, second, 0.25, (time) => {
    const phase = 2 * Math.PI * (50 * time + (100 / 30) * (1 - Math.exp(-30 * time)));
    return level * Math.sin(phase) * Math.exp(-14 * time);
  });
}

/** A plucked tone, hertz. */
export function tone(song: Float32Array, second: number, hertz: number, length: number, level: number): void {
  add(song, second, length, (time) => {
    const fade = Math.min(1, time / 0.005, (length - time) / 0.01) * Math.exp(-3 * time);
    return level * fade * (Math.sin(2 * Math.PI * hertz * time) + 0.5 * Math.sin(4 * Math.PI * hertz * time));
  });
}

/** Clicks, each first of a bar louder and with a bass drum. */
export function clicks(bpm: number, beatsPerBar: number, seconds = 24, begin = 0.3): Float32Array {
  const song = quiet(seconds);
  for (let beat = 0; begin + (beat * 60) / bpm < seconds - 0.2; beat++) {
    const second = begin + (beat * 60) / bpm;
    stroke(song, second, beat % beatsPerBar === 0 ? 1 : 0.5);
    if (beat % beatsPerBar === 0) kick(song, second, 1);
  }
  return song;
}

const ROOTS = [110, 87.3, 130.8, 98] as const;

/** Drums, bass and chords in bars of four, with offbeats at `swing` of a beat: 1/2 is straight, 2/3 is swung. */
export function swung(bpm: number, swing: number, seconds = 24): Float32Array {
  const song = quiet(seconds);
  const beat = 60 / bpm;
  for (let index = 0; 0.5 + index * beat < seconds - 0.2; index++) {
    const second = 0.5 + index * beat;
    const root = ROOTS[Math.floor(index / 4) % 4]!;
    if (index % 2 === 0) kick(song, second, 0.9);
    else stroke(song, second, 0.6, 20);
    stroke(song, second, 0.3, 60);
    stroke(song, second + swing * beat, 0.25, 60);
    tone(song, second, root / 2, beat * 0.9, 0.5);
    if (index % 4 === 0) for (const part of [2, 2.5, 3]) tone(song, second, part * root, 4 * beat, 0.2);
  }
  return song;
}

/** Bass on one, chords on two and three; the harmony changes every second bar. */
export function waltz(bpm: number, seconds = 24): Float32Array {
  const song = quiet(seconds);
  const beat = 60 / bpm;
  for (let index = 0; 0.2 + index * beat < seconds - 0.2; index++) {
    const second = 0.2 + index * beat;
    const root = ROOTS[Math.floor(index / 6) % 4]!;
    if (index % 3 === 0) tone(song, second, root / 2, beat * 1.2, 0.9);
    else for (const part of [2, 2.5, 3]) tone(song, second, part * root, beat * 0.6, 0.3);
    stroke(song, second, index % 3 === 0 ? 0.3 : 0.15, 60);
  }
  return song;
}

/** One after the other. */
export function joined(...parts: readonly Float32Array[]): Float32Array {
  const song = new Float32Array(parts.reduce((sum, part) => sum + part.length, 0));
  let at = 0;
  for (const part of parts) {
    song.set(part, at);
    at += part.length;
  }
  return song;
}

export function whiteNoise(seconds: number, seed: number): Float32Array {
  const random = randomNumbers(seed);
  return Float32Array.from({ length: seconds * rate }, () => 0.6 * (random() - 0.5));
}

/** Strokes at random moments, five a second: rain. */
export function rain(seconds: number, seed: number): Float32Array {
  const song = quiet(seconds);
  const random = randomNumbers(seed);
  for (let drop = 0; drop < 5 * seconds; drop++) stroke(song, random() * seconds, random());
  return song;
}

/** Long tones that glide and tremble, with pauses: a whale. */
export function whale(seconds: number, seed: number): Float32Array {
  const song = quiet(seconds);
  const random = randomNumbers(seed);
  for (let second = 0.5; second < seconds - 1;) {
    const length = 0.6 + 3.4 * random();
    const [from, to, tremble] = [120 + 780 * random(), 120 + 780 * random(), 0.5 + 4.5 * random()];
    let phase = 0;
    add(song, second, length, (time) => {
      const hertz = from + (to - from) * (time / length) + 20 * Math.sin(2 * Math.PI * tremble * time);
      phase += (2 * Math.PI * hertz) / rate;
      return (
        0.3 * Math.sqrt(Math.sin((Math.PI * time) / length)) * (Math.sin(phase) + Math.sin(2 * phase) / 2)
      );
    });
    second += length + 1.5 * random();
  }
  return song;
}
