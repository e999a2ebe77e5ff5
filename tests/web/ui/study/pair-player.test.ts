import { afterEach, beforeEach, expect, it, vi } from 'vitest';
import { AudioPlayer } from '../../../../web/audio/client';
import { PairPlayer } from '../../../../web/ui/study/pair-player';
import { still } from '../../support/made-state';

/** What the page would draw next. */
const waiting = new Map<number, () => void>();
let frames = 0;

/** An element without a song. */
class SilentAudio {
  readonly paused = true;
  readonly ended = false;
  readonly pause = (): void => undefined;
  readonly load = (): void => undefined;
  readonly removeAttribute = (): void => undefined;
}

beforeEach(() => {
  vi.stubGlobal('Audio', SilentAudio);
  vi.stubGlobal('requestAnimationFrame', (draw: () => void) => waiting.set(++frames, draw) && frames);
  vi.stubGlobal('cancelAnimationFrame', (frame: number) => waiting.delete(frame));
});

afterEach(() => {
  vi.unstubAllGlobals();
  waiting.clear();
});

function opened(): PairPlayer {
  const player = new PairPlayer(null, new AudioPlayer(), () => undefined);
  player.show({ leader: still(30), left: still(30), right: still(30), song: null });
  return player;
}

it('a pause while the sound is starting ends the drawing too', async () => {
  const player = opened();
  const starting = player.play();
  player.pause();
  await starting;
  expect(player.playing).toBe(false);
  expect(waiting.size).toBe(0);
});

it('draws in one loop, also where play was asked for again meanwhile, and a pause ends it', async () => {
  const player = opened();
  const starting = player.play();
  player.pause();
  await Promise.all([starting, player.play()]);
  expect(waiting.size).toBe(1);
  for (const [frame, draw] of [...waiting]) {
    waiting.delete(frame);
    draw();
  }
  expect(waiting.size).toBe(1);
  player.pause();
  expect(waiting.size).toBe(0);
});
