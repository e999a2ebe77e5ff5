/** Playback, camera, theme, overlays and floating panels. */
import { danceDuration } from '../selectors';
import type { View } from '../../../common/framing';
import type { VisibleOverlays, Theme } from '../../../common/picture';
import type { Reaction } from '../reaction';
import type { AppState, CoarseLayer, Playback } from '../state';
import type { Change } from '../store';

export const SPEEDS = [0.25, 0.5, 0.75, 1, 1.25, 1.5, 2] as const;

/** Changes playback; the time is clamped to the dance. */
export function playbackSet(change: Partial<Playback>): Change {
  return (state) => {
    const playback = { ...state.playback, ...change };
    const time = Math.min(danceDuration(state), Math.max(0, playback.time));
    return { playback: { ...playback, time } };
  };
}

export function themeSet(theme: Theme): Change {
  return () => ({ theme });
}

export function letterKeysSet(letterKeys: boolean): Change {
  return () => ({ letterKeys });
}

export function cameraSet(camera: View): Change {
  return () => ({ camera });
}

/** A panel covers so many CSS pixels of the stage, from the left. */
export function stageCovered(covered: number): Change {
  return () => ({ covered });
}

export function updateSet(update: boolean): Change {
  return () => ({ update });
}

/** Turns an overlay on or off. */
export function overlayToggled(what: keyof VisibleOverlays): Change {
  return ({ overlays }) => ({ overlays: { ...overlays, [what]: !overlays[what] } });
}

export function coarseChanged(change: Partial<CoarseLayer>): Change {
  return ({ coarse }) => ({ coarse: { ...coarse, ...change } });
}

/** Shows the reaction before a change as a ghost; null ends that. */
export function earlierShown(earlier: Reaction | null): Change {
  return () => ({ earlier });
}

/** Opens a floating panel, or closes it when it is the one that is open. */
export function panelToggled(open: AppState['openPanel']): Change {
  return (state) => ({ openPanel: state.openPanel === open ? null : open });
}
