import { afterEach, beforeEach, expect, it, vi } from 'vitest';
import { PlaybackClock } from '../../../web/audio/playback-clock';

let clock: PlaybackClock;
/** Lets a time pass, milliseconds. */
const pass = (milliseconds: number) => vi.advanceTimersByTime(milliseconds);
/** The time while a song of eight seconds that begins at 2 s is at this position, seconds. */
const withSong = (position: number, length = 8) => clock.read({ position, length, songStart: 2 });

beforeEach(() => {
  vi.useFakeTimers({ toFake: ['performance'] });
  clock = new PlaybackClock();
  clock.duration = 20;
});
afterEach(() => {
  vi.useRealTimers();
});

it('goes on from where it was started, at its speed, to the end of the dance', () => {
  clock.speed = 0.5;
  clock.restart(18);
  pass(1000);
  expect(clock.read(null)).toBeCloseTo(18.5);
  expect(clock.latest).toBeCloseTo(18.5);
  pass(9000);
  expect(clock.read(null)).toBe(20);
  clock.restart();
  expect(clock.latest).toBe(18);
  clock.restart(-1);
  expect(clock.latest).toBe(0);
});

it('goes on between two positions of a song that comes in steps, at its speed, but not for long', () => {
  clock.restart(5);
  clock.speed = 0.5;
  expect(withSong(3)).toBe(5);
  pass(60);
  expect(withSong(3), 'a song that may not have begun to sound').toBe(5);
  expect(withSong(3.25)).toBe(5.25);
  pass(60);
  expect(withSong(3.25)).toBeCloseTo(5.28);
  pass(1000);
  expect(withSong(3.25), 'a song that waits for its data').toBeCloseTo(5.35);
  clock.restart(5.25);
  expect(withSong(3.25), 'a song that starts where it was left').toBe(5.25);
});

it('never runs backwards, nor on beyond the end of the song', () => {
  clock.restart(9);
  withSong(7);
  expect(withSong(7.9)).toBeCloseTo(9.9);
  expect(withSong(7.8)).toBeCloseTo(9.9);
  withSong(7.95);
  pass(90);
  expect(withSong(7.95)).toBe(10);
  expect(withSong(8.05, NaN), 'before its length is known').toBeCloseTo(10.05);
});
