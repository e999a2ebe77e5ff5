import { coarseIsMissing } from '../generation/coarse-layer';
import { listen, together } from '../widgets/dom';
import { danceDuration, danceFps } from '../store/selectors';
import type { Services } from '../store/services';
import { SHOWS } from '../store/overlays';
import type { Camera, Shown } from '../store/state';
import { guidanceReset, seedRolled, rolledSeed } from '../store/actions/settings';
import { apply, type Store } from '../store/store';
import { dismissed } from '../store/actions/notices';
import { cameraSet, opened, playbackSet, shownToggled, SPEEDS } from '../store/actions/view';
import { regionEndSet, regionSet, zoomedBy, zoomSet } from '../store/actions/timeline';
import { ZOOM_STEP } from '../timeline/zoom-control';
import { takeStarred } from '../store/actions/takes';
import { takeOnStage } from '../store/take';

/**
 * The keys of the page. Letters rest while someone types; arrows, Home and End rest on sliders of their own;
 * Space on a control that was reached by keyboard presses that control.
 */
export function mountKeyboard(store: Store, services: Services): () => void {
  let byPointer = true;
  const onKey = (event: KeyboardEvent): void => {
    if (event.key === 'Tab') byPointer = false;
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const target = event.target instanceof HTMLElement ? event.target : document.body;
    if (event.key === 'Escape') {
      // The browser itself closes a popover, and nothing else is meant then.
      if (document.querySelector(':popover-open')) return;
      if (escape(store, services)) event.preventDefault();
      return;
    }
    if (target.matches('input[type="number"], input[type="text"], select, textarea')) return;
    const ownsArrows = target.matches('input[type="range"], [role="radio"]');
    if (/^(Arrow|Home|End|Page)/.test(event.key) && ownsArrows) return;
    if ((event.key === ' ' || event.key === 'Enter') && target.matches('button') && !byPointer) return;
    if (press(event, store, services)) event.preventDefault();
  };
  // A button that was clicked keeps the focus and would be pressed again by the release of Space.
  const onRelease = (event: KeyboardEvent): void => {
    if (event.key === ' ' && byPointer && event.target instanceof HTMLButtonElement) event.preventDefault();
  };
  return together(
    listen(window, 'keydown', onKey),
    listen(window, 'keyup', onRelease),
    listen(
      window,
      'pointerdown',
      () => {
        byPointer = true;
      },
      { capture: true },
    ),
  );
}

/** Closes or cancels the one thing in front; true if there was one. */
function escape(store: Store, services: Services): boolean {
  const { problem, open, job, variations, playback } = store.getState();
  if (problem) apply(store, dismissed());
  else if (open) apply(store, opened(open));
  else if (job || variations?.making) services.cancel();
  else if (playback.region) apply(store, regionSet(null));
  else return false;
  return true;
}

function press(event: KeyboardEvent, store: Store, services: Services): boolean {
  const state = store.getState();
  const { time, speed, loop } = state.playback;
  const frame = 1 / danceFps(state);
  const hop = event.shiftKey ? 1 : frame;
  switch (event.key) {
    case ' ':
      services.togglePlay();
      return true;
    case 'ArrowLeft':
      services.seek(time - hop);
      return true;
    case 'ArrowRight':
      services.seek(time + hop);
      return true;
    case 'Home':
      services.seek(0);
      return true;
    case 'End':
      services.seek(danceDuration(state));
      return true;
    case '[':
      apply(store, playbackSet({ speed: beside(speed, -1) }));
      return true;
    case ']':
      apply(store, playbackSet({ speed: beside(speed, 1) }));
      return true;
    case '+':
    case '=':
      apply(store, zoomedBy(ZOOM_STEP));
      return true;
    case '-':
      apply(store, zoomedBy(1 / ZOOM_STEP));
      return true;
    case '0':
      apply(store, zoomSet(null));
      return true;
    case '?':
      apply(store, opened('keys'));
      return true;
  }
  const show = SHOWS.find(({ key }) => key === event.key.toUpperCase());
  if (show) {
    toggleShow(store, show.what);
    return true;
  }
  const onStage = takeOnStage(state);
  switch (event.key.toLowerCase()) {
    case 'l':
      apply(store, playbackSet({ loop: !loop }));
      return true;
    case 'i':
      apply(store, regionEndSet('from', time));
      return true;
    case 'o':
      apply(store, regionEndSet('to', time));
      return true;
    case 'c':
      focusFader('Coarse guidance');
      return true;
    case 'v':
      focusFader('Fine guidance');
      return true;
    case 'm':
      focusFader('Music guidance');
      return true;
    case 'r':
      apply(store, guidanceReset());
      return true;
    case 'd':
      apply(store, seedRolled(rolledSeed()));
      return true;
    case 'f':
      toggleCamera(store, 'follow');
      return true;
    case 't':
      toggleCamera(store, 'top');
      return true;
    case 'x':
      toggleCamera(store, 'side');
      return true;
    case 'a':
      services.frameBoth();
      return true;
    case 's':
      if (onStage) apply(store, takeStarred(onStage.id));
      return true;
    case 'e':
      if (state.reaction) apply(store, opened('download'));
      return true;
  }
  return false;
}

/** The next slower or faster of the offered speeds. */
function beside(speed: number, by: 1 | -1): number {
  const at = SPEEDS.findIndex((value) => value === speed);
  return SPEEDS[Math.min(SPEEDS.length - 1, Math.max(0, at + by))] ?? 1;
}

function focusFader(label: string): void {
  document.querySelector<HTMLInputElement>(`input[aria-label="${label}"]`)?.focus();
}

function toggleCamera(store: Store, camera: Camera): void {
  apply(store, cameraSet(store.getState().camera === camera ? 'orbit' : camera));
}

/** A coarse ghost that can't be seen opens the menu, which says why and what to do. */
function toggleShow(store: Store, what: keyof Shown): void {
  apply(store, shownToggled(what));
  const { shown, open, visiting } = store.getState();
  const silent = what === 'ghost' && shown.ghost && coarseIsMissing(store.getState());
  if (silent && open === null && !visiting) apply(store, opened('show'));
}
