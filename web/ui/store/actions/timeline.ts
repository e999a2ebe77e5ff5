import { danceDuration } from '../selectors';
import { shiftRange } from '../song-shift';
import type { AppState } from '../state';
import type { Change } from '../store';
import { largestMagnification, magnification, spanShowing, type Span, zoomed } from '../time-scale';

/** Shortest loop, seconds: two frames and a beat of a fast song are well apart. */
export const SHORTEST_LOOP = 0.2;

/** The part of the dance that the lanes show. */
export function visibleSpan(state: Pick<AppState, 'zoom' | 'leader' | 'song'>): Span {
  return state.zoom ?? { from: 0, to: danceDuration(state) };
}

/** Shows this part of the dance; all of it is no zoom. */
export function zoomSet(span: Span | null): Change {
  return (state) => {
    const whole = danceDuration(state);
    const all = !span || span.to - span.from >= whole - 1e-6;
    return { zoom: all ? null : span };
  };
}

/** Zooms by a factor around a time; around the playhead where none is given and it is in sight. */
export function zoomedBy(factor: number, around?: number): Change {
  return (state) => {
    const span = visibleSpan(state);
    const { time } = state.playback;
    const inSight = time >= span.from && time <= span.to;
    const middle = around ?? (inSight ? time : (span.from + span.to) / 2);
    return zoomSet(zoomed(span, danceDuration(state), factor, middle))(state);
  };
}

/** Zooms so that the picture is this many times larger than the whole dance in one view. */
export function magnificationSet(times: number): Change {
  return (state) => {
    const whole = danceDuration(state);
    const held = Math.min(largestMagnification(whole), Math.max(1, times));
    return zoomedBy(held / magnification(visibleSpan(state), whole))(state);
  };
}

/** Brings a time into the picture. */
export function scrolledTo(time: number): Change {
  return (state) => (state.zoom ? { zoom: spanShowing(state.zoom, danceDuration(state), time) } : {});
}

/** Sets the region that a loop goes round in and turns looping on; null takes it away and turns it off. */
export function regionSet(span: Span | null): Change {
  return (state) => {
    const whole = danceDuration(state);
    if (!span || whole < SHORTEST_LOOP) return { playback: { ...state.playback, region: null, loop: false } };
    const [first, last] = [Math.min(span.from, span.to), Math.max(span.from, span.to)];
    const from = Math.min(Math.max(0, first), whole - SHORTEST_LOOP);
    const to = Math.min(whole, Math.max(last, from + SHORTEST_LOOP));
    return { playback: { ...state.playback, region: { from, to }, loop: true } };
  };
}

/** Puts one end of the region at a time; the other one stays where it makes sense, or is the dance's. */
export function regionEndSet(end: 'from' | 'to', time: number): Change {
  return (state) => {
    const whole = danceDuration(state);
    const { from, to } = state.playback.region ?? { from: 0, to: whole };
    if (end === 'from') return regionSet({ from: time, to: to > time + SHORTEST_LOOP ? to : whole })(state);
    return regionSet({ from: from < time - SHORTEST_LOOP ? from : 0, to: time })(state);
  };
}

/** Starts the song this many frames later than the dance, as long as something of it is heard. */
export function shiftSet(frames: number): Change {
  return (state) => {
    const { min, max } = shiftRange(state);
    const shift = Math.min(max, Math.max(min, Math.round(frames)));
    return shift === state.shift ? {} : { shift };
  };
}
