import { countedBeats, snapped } from '../counting';
import { danceDuration } from '../selectors';
import { shiftRange } from '../song-shift';
import type { AppState } from '../state';
import type { Change } from '../store';
import { largestMagnification, magnification, spanShowing, type Span, zoomed } from '../time-scale';

/** Shortest loop, seconds: more than two frames, less than a beat of a fast song. */
export const MIN_LOOP = 0.2;

/** The part of the dance that the lanes show. */
export function visibleSpan(state: Pick<AppState, 'zoom' | 'leader' | 'song'>): Span {
  return state.zoom ?? { from: 0, to: danceDuration(state) };
}

/** Shows this part of the dance; null, or the whole dance, ends the zoom. */
export function zoomSet(span: Span | null): Change {
  return (state) => {
    const whole = danceDuration(state);
    const all = !span || span.to - span.from >= whole - 1e-6;
    return { zoom: all ? null : span };
  };
}

/** Zooms by a factor around a time; without one around the playhead if it is shown, else around the middle. */
export function zoomedBy(factor: number, around?: number): Change {
  return (state) => {
    const span = visibleSpan(state);
    const { time } = state.playback;
    const isShown = time >= span.from && time <= span.to;
    const middle = around ?? (isShown ? time : (span.from + span.to) / 2);
    return zoomSet(zoomed(span, danceDuration(state), factor, middle))(state);
  };
}

/** Zooms so that the dance is drawn this many times larger than in a view of all of it. */
export function magnificationSet(times: number): Change {
  return (state) => {
    const whole = danceDuration(state);
    const clamped = Math.min(largestMagnification(whole), Math.max(1, times));
    return zoomedBy(clamped / magnification(visibleSpan(state), whole))(state);
  };
}

/** Scrolls so that a time is shown. */
export function scrolledTo(time: number): Change {
  return (state) => (state.zoom ? { zoom: spanShowing(state.zoom, danceDuration(state), time) } : {});
}

/** Sets the region that is looped and turns looping on; null removes it and turns looping off. */
export function regionSet(span: Span | null): Change {
  return (state) => {
    const whole = danceDuration(state);
    if (!span || whole < MIN_LOOP) return { playback: { ...state.playback, region: null, loop: false } };
    const [first, last] = [Math.min(span.from, span.to), Math.max(span.from, span.to)];
    const from = Math.min(Math.max(0, first), whole - MIN_LOOP);
    const to = Math.min(whole, Math.max(last, from + MIN_LOOP));
    return { playback: { ...state.playback, region: { from, to }, loop: true } };
  };
}

/** Sets one end of the region; the other end stays if it is far enough away, else it is that of the dance. */
export function regionEndSet(end: 'from' | 'to', time: number): Change {
  return (state) => {
    const whole = danceDuration(state);
    const { from, to } = state.playback.region ?? { from: 0, to: whole };
    if (end === 'from') return regionSet({ from: time, to: to > time + MIN_LOOP ? to : whole })(state);
    return regionSet({ from: from < time - MIN_LOOP ? from : 0, to: time })(state);
  };
}

/** The same on the beat nearest to a time; on the time itself where there is none. */
export function regionEndSetOnBeat(end: 'from' | 'to', time: number): Change {
  return (state) => regionEndSet(end, snapped(countedBeats(state), time))(state);
}

/** Starts the song this many frames later than the dance, clamped to `shiftRange`. */
export function shiftSet(frames: number): Change {
  return (state) => {
    const { min, max } = shiftRange(state);
    const shift = Math.min(max, Math.max(min, Math.round(frames)));
    return shift === state.shift ? {} : { shift };
  };
}
