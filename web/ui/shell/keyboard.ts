import { type Control, faderId } from '../widgets/fader';
import { barBeside } from '../store/counting';
import { danceDuration, danceFps } from '../store/selectors';
import type { Services } from '../store/services';
import { OVERLAYS, toggleOverlay } from './overlay-menu';
import type { View } from '../../common/framing';
import type { AppState } from '../store/state';
import { guidanceReset, seedRandomized, randomSeed } from '../store/actions/settings';
import { apply, type Store } from '../store/store';
import { givenSet } from '../store/actions/files';
import { problemDismissed } from '../store/actions/notices';
import { cameraSet, panelToggled, playbackSet, SPEEDS } from '../store/actions/view';
import { regionEndSetOnBeat, regionSet, zoomedBy, zoomSet } from '../store/actions/timeline';
import { ZOOM_STEP } from '../timeline/zoom-control';
import { settingOneSet } from '../store/actions/counting';
import { canSwapTakes, takesSwapped, takeStarred } from '../store/actions/takes';
import { takeOnStage } from '../store/take';

/** What one press does to the camera: a turn in radians, and a factor of its distance. */
const [CAMERA_TURN, CAMERA_FACTOR] = [Math.PI / 12, 1.15];

/** Where the page moves the focus itself, whatever was pressed before. */
const DIALOGS = '[role="dialog"], [role="alertdialog"]';

/**
 * The keys of the page. Letters do nothing while someone types; arrows, Home and End belong to a slider or a choice that
 * has the focus; Space sets a checkbox, and presses a button in a dialog or one that the focus came to by keyboard.
 */
export function mountKeyboard(store: Store, services: Services): void {
  /** Whether the last press was of a key, and whether it was when the focus came to where it is. */
  let keyIsLast = false;
  let byKey = false;
  let focused: EventTarget | null = null;
  const isPressedByKeys = (target: EventTarget | null): boolean =>
    (target instanceof HTMLButtonElement || target instanceof HTMLSelectElement) &&
    (byKey || target.closest(DIALOGS) !== null);
  const onKey = (event: KeyboardEvent): void => {
    // Many keyboards type [ and ] with AltGr, which Windows reports as Ctrl and Alt.
    const typesSign = event.key.length === 1 && event.getModifierState('AltGraph');
    if ((event.ctrlKey || event.metaKey || event.altKey) && !typesSign) return;
    const target = event.target instanceof HTMLElement ? event.target : document.body;
    if (flipsOnStage(event, target, store)) {
      event.preventDefault();
      apply(store, takesSwapped());
      return;
    }
    if (event.key === 'Escape') {
      // The browser itself closes a popover, and nothing else then.
      if (document.querySelector(':popover-open')) return;
      if (escape(store, services)) event.preventDefault();
      return;
    }
    if (ownsKey(target, event.key)) return;
    if ((event.key === ' ' || event.key === 'Enter') && isPressedByKeys(target)) return;
    const { letterKeys, problem, given } = store.getState();
    // Nothing changes unseen behind a dialog that waits for an answer.
    if ((!letterKeys || problem || given) && isLetterKey(event.key)) return;
    if (press(event, store, services)) event.preventDefault();
  };
  // A clicked button keeps the focus, and releasing Space would press it again.
  const onRelease = (event: KeyboardEvent): void => {
    const { key, target } = event;
    if (key === ' ' && target instanceof HTMLButtonElement && !isPressedByKeys(target))
      event.preventDefault();
  };
  const onFocus = ({ target }: FocusEvent): void => {
    // It also comes again when the window does.
    if (target !== focused) byKey = keyIsLast;
    focused = target;
  };
  // With the focus, a menu that was chosen from by mouse would take letters and Space for the next choice.
  const onChoice = ({ target }: Event): void => {
    if (target instanceof HTMLSelectElement && !isPressedByKeys(target)) target.blur();
  };
  window.addEventListener('change', onChoice);
  window.addEventListener('keydown', onKey);
  window.addEventListener('keyup', onRelease);
  window.addEventListener('focusin', onFocus);
  window.addEventListener('keydown', () => void (keyIsLast = true), { capture: true });
  window.addEventListener('pointerdown', () => void (keyIsLast = byKey = false), { capture: true });
}

/** Whether an element does something of its own with a key: typing, or to be chosen or moved. */
function ownsKey(element: HTMLElement, key: string): boolean {
  if (element.matches('input[type="number"], input[type="text"], select, textarea')) return true;
  if (/^(Arrow|Home|End|Page)/.test(key))
    return element.matches('input[type="range"], input[type="radio"], [role="radio"]');
  return key === ' ' && element.matches('input[type="checkbox"], input[type="radio"], summary');
}

/** Whether it is the key of a letter, a digit or a sign, which speech input may type by mistake. */
const isLetterKey = (key: string): boolean => key.length === 1 && key !== ' ';

/**
 * Whether the key is Tab on the picture, where it flips the compared takes. Only a click brings the focus there, so that
 * nobody who goes through the page by Tab is held up; with Shift it leaves the picture.
 */
function flipsOnStage({ key, shiftKey }: KeyboardEvent, target: HTMLElement, store: Store): boolean {
  return key === 'Tab' && !shiftKey && target.matches('.picture') && canSwapTakes(store.getState());
}

/** Closes the problem or panel in front, or ends setting the "1", cancels the job, or removes the region; false if there is none of these. */
function escape(store: Store, services: Services): boolean {
  const { problem, given, settingOne, openPanel, job, variations, playback } = store.getState();
  if (problem) apply(store, problemDismissed());
  else if (given) apply(store, givenSet(null));
  else if (settingOne) apply(store, settingOneSet(false));
  else if (openPanel) apply(store, panelToggled(openPanel));
  else if (job || variations?.making) services.cancel();
  else if (playback.region) apply(store, regionSet(null));
  else return false;
  return true;
}

/** What keys do, by `event.key`; letters in lower case. */
const ACTIONS: Readonly<Record<string, (key: KeyPress) => void>> = {
  ' ': ({ services }) => services.togglePlay(),
  ArrowLeft: (key) => key.services.seek(arrowTarget(key, -1)),
  ArrowRight: (key) => key.services.seek(arrowTarget(key, 1)),
  '1': (key) => pickVariation(key, 0),
  '2': (key) => pickVariation(key, 1),
  '3': (key) => pickVariation(key, 2),
  Home: ({ services }) => services.seek(0),
  End: ({ services, state }) => services.seek(danceDuration(state)),
  '[': ({ store, state }) => apply(store, playbackSet({ speed: nextSpeed(state.playback.speed, -1) })),
  ']': ({ store, state }) => apply(store, playbackSet({ speed: nextSpeed(state.playback.speed, 1) })),
  '+': ({ store }) => apply(store, zoomedBy(ZOOM_STEP)),
  '=': ({ store }) => apply(store, zoomedBy(ZOOM_STEP)),
  '-': ({ store }) => apply(store, zoomedBy(1 / ZOOM_STEP)),
  '0': ({ store }) => apply(store, zoomSet(null)),
  '?': ({ store }) => apply(store, panelToggled('keys')),
  l: ({ store, state }) => apply(store, playbackSet({ loop: !state.playback.loop })),
  i: ({ store, time }) => apply(store, regionEndSetOnBeat('from', time)),
  o: ({ store, time }) => apply(store, regionEndSetOnBeat('to', time)),
  c: () => focusFader('coarse'),
  v: () => focusFader('fine'),
  m: () => focusFader('music'),
  y: () => focusFader('variety'),
  r: ({ store }) => apply(store, guidanceReset()),
  d: ({ store }) => apply(store, seedRandomized(randomSeed())),
  f: ({ store }) => toggleCamera(store, 'follow'),
  t: ({ store }) => toggleCamera(store, 'top'),
  x: ({ store }) => toggleCamera(store, 'side'),
  a: ({ services }) => services.frameBoth(),
  ',': ({ services }) => services.stepCamera(-CAMERA_TURN, 1),
  '.': ({ services }) => services.stepCamera(CAMERA_TURN, 1),
  u: ({ services }) => services.stepCamera(0, 1 / CAMERA_FACTOR),
  j: ({ services }) => services.stepCamera(0, CAMERA_FACTOR),
  s: ({ store, state }) => {
    const take = takeOnStage(state);
    if (take) apply(store, takeStarred(take.id));
  },
  e: ({ store, state }) => {
    if (state.reaction) apply(store, panelToggled('download'));
  },
};

/** Keys that act again while they are held: they move or zoom something bit by bit. */
const REPEATING: ReadonlySet<string> = new Set([
  'ArrowLeft',
  'ArrowRight',
  '+',
  '=',
  '-',
  ',',
  '.',
  'u',
  'j',
]);

interface KeyPress {
  readonly store: Store;
  readonly services: Services;
  readonly state: AppState;
  readonly shift: boolean;
  /** Of the playhead, seconds. */
  readonly time: number;
}

/** Does what a key is for; false for a key that does nothing. */
function press({ key, shiftKey: shift, repeat }: KeyboardEvent, store: Store, services: Services): boolean {
  const overlay = OVERLAYS.find((one) => one.key === key.toUpperCase());
  const name = key.length === 1 ? key.toLowerCase() : key;
  const action = ACTIONS[name];
  const state = store.getState();
  if (!repeat || REPEATING.has(name)) {
    if (overlay) toggleOverlay(store, overlay.what);
    else action?.({ store, services, state, shift, time: state.playback.time });
  }
  return overlay !== undefined || action !== undefined;
}

/** Where an arrow moves the playhead, seconds: by one frame, with Shift to the start of a bar. */
function arrowTarget({ shift, state, time }: KeyPress, direction: 1 | -1): number {
  return shift ? barBeside(state, time, direction) : time + direction / danceFps(state);
}

/** Shows one of the reactions to pick from, if it is made. */
function pickVariation({ services, state }: KeyPress, index: number): void {
  const seed = state.variations?.list[index]?.seed ?? null;
  if (seed !== null) services.pickVariation(seed);
}

/** The next slower or faster of the offered speeds. */
function nextSpeed(speed: number, by: 1 | -1): number {
  const at = SPEEDS.findIndex((value) => value === speed);
  return SPEEDS[Math.min(SPEEDS.length - 1, Math.max(0, at + by))] ?? 1;
}

function focusFader(control: Control): void {
  document.getElementById(faderId(control))?.focus();
}

function toggleCamera(store: Store, camera: View): void {
  apply(store, cameraSet(store.getState().camera === camera ? 'orbit' : camera));
}
