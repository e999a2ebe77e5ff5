/** Binds a stage to the state: which dancers and overlays it shows, and when. Opens stages for videos. */
import type { PictureSize } from './common/picture';
import { dancers, generatedRole } from './ui/store/roles';
import { besideStage } from './ui/generation/coarse-layer';
import { combineDisposers } from './ui/widgets/dom';
import type { VideoStage } from './ui/download/video-stage';
import { coarseMotion, earlierMotion, otherCoarseMotion } from './ui/store/reactor-motion';
import type { AppState } from './ui/store/state';
import { type Store, watch, watchAll, type Watched } from './ui/store/store';
import { isReading } from './ui/store/selectors';
import { showOther } from './ui/takes/other-dancer';
import type { createOffscreenStage } from './view/offscreen-stage';
import type { Stage } from './view/stage';

const reducedMotion = matchMedia('(prefers-reduced-motion: reduce)');

/** Time after a generation in which the page still measures the result and the earlier dance fades, milliseconds. */
const BUSY_AFTER_MS = 2500;

/**
 * The state as the stage on the page shows it: while a video is read, its dancer is alone on the stage as far as they are
 * read, except while the present dance is played.
 */
export function withPartRead(store: Store): Watched {
  const onStage = (state: AppState): AppState => {
    const { partRead, playback, coarse } = state;
    if (!partRead || playback.playing) return state;
    return {
      ...state,
      leader: partRead.leader,
      reaction: null,
      preview: null,
      earlier: null,
      compare: 'off',
      coarse: { ...coarse, motion: null, other: null },
      playback: { ...playback, time: partRead.time },
    };
  };
  return {
    getState: () => onStage(store.getState()),
    subscribe: (listener) => store.subscribe((state) => listener(onStage(state))),
  };
}

/** Updates a stage whenever the state changes; returns a function that stops it. */
export function bindStage(stage: Stage, store: Watched): () => void {
  return combineDisposers(
    watch(
      store,
      (state) => state.theme,
      (theme) => stage.setTheme(theme),
    ),
    bindDancers(stage, store),
    watchAll(
      store,
      (state) => [coarseMotion(state), otherCoarseMotion(state)],
      (state) => stage.setCoarse(coarseMotion(state), otherCoarseMotion(state)),
    ),
    watch(
      store,
      (state) => state.overlays,
      (overlays) => stage.setOverlays(overlays),
    ),
    showOther(store, stage),
    watch(store, earlierMotion, (motion, { reaction, compare }) => {
      // It leaves at once where the dance that it was before leaves too, or another ghost comes.
      const fade = reaction !== null && compare === 'off' && !reducedMotion.matches;
      stage.setEarlier(motion, fade);
    }),
    bindBusy(stage, store),
    watch(
      store,
      (state) => state.job,
      (job, { reaction }) => {
        // Weights of guidance change frames of the dance that is there; anything else takes longer.
        if (job?.stage === 'waiting' && reaction) stage.expectFrames();
      },
    ),
    watch(
      store,
      (state) => state.playback.time,
      (time) => stage.setTime(time),
    ),
    watch(
      store,
      (state) => state.camera,
      (camera) => stage.setCamera(camera),
    ),
    // A detail is shown while its seconds are looped.
    watch(
      store,
      (state) => state.playback.region,
      () => stage.endFocus(),
    ),
  );
}

/**
 * Shows the couple. One reaction crossfades to the next; switching the generated role, the foot lock or the takes of a
 * split view is shown at once, and so is a preview, which is to follow the hand.
 */
function bindDancers(stage: Stage, store: Watched): () => void {
  let before = '';
  return watchAll(
    store,
    (state) => Object.values(dancers(state)),
    (state) => {
      const half = besideStage(state) && state.letter;
      const now = `${generatedRole(state)} ${state.footLock} ${half}`;
      const crossfade = now === before && state.preview === null && !reducedMotion.matches;
      stage.setDancers(dancers(state), { made: generatedRole(state), crossfade });
      before = now;
    },
  );
}

/** Tells the stage that the page is busy while files are read or a reaction is generated, and shortly afterwards. */
function bindBusy(stage: Stage, store: Watched): () => void {
  let timer: ReturnType<typeof setTimeout> | undefined;
  return combineDisposers(
    watch(
      store,
      (state) => state.job !== null || isReading(state).includes(true),
      (busy) => {
        clearTimeout(timer);
        if (busy) stage.setBusy(true);
        else timer = setTimeout(() => stage.setBusy(false), BUSY_AFTER_MS);
      },
    ),
    () => clearTimeout(timer),
  );
}

/**
 * Windows that are wide enough for the dancers beside the first-visit block, and low ones, where it is narrower: 761 and
 * 500 pixels of the style sheets, which the build turns into rem.
 */
const WIDE = matchMedia('(min-width: 47.5625rem)');
const LOW = matchMedia('(max-height: 31.25rem)');
const FIRST_VISIT_SHIFT_REM = { low: 8.4375, high: 12.5 };
/** Height of the cameras and of the stage's tools, along the edges of the picture. */
const CONTROLS_REM = 2.75;

/** Keeps the dancers clear of the first-visit block, a leader's video and the stage's controls. */
export function leaveRoomForControls(stage: Stage, store: Store): void {
  const leave = (): void => {
    const { firstVisit, covered } = store.getState();
    const rem = parseFloat(getComputedStyle(document.documentElement).fontSize);
    const beside = WIDE.matches ? FIRST_VISIT_SHIFT_REM[LOW.matches ? 'low' : 'high'] * rem : 0;
    const left = firstVisit ? beside : covered / 2;
    stage.leaveRoom({ left, edges: firstVisit ? 0 : CONTROLS_REM * rem });
  };
  for (const query of [WIDE, LOW]) query.addEventListener('change', leave);
  watchAll(store, (state) => [state.firstVisit, state.covered], leave);
}

/**
 * Opens an offscreen stage for a video or a picture: it shows the finished dance that `from` shows now, as that frames it,
 * and does not follow later changes.
 *
 * @param begin moment of the first picture, seconds
 */
export async function openCamera(
  from: Stage,
  store: Store,
  size: PictureSize,
  begin: number,
  createStage: typeof createOffscreenStage,
): Promise<VideoStage> {
  const stage = createStage(from, size);
  try {
    // A preview is half of the old dance and half of the new one.
    const finished = { ...store.getState(), preview: null };
    bindStage(stage, { getState: () => finished, subscribe: () => () => undefined })();
    stage.setEarlier(null);
    const framing = from.framing();
    await stage.ready();
    stage.setTime(begin);
    stage.frameAs(framing);
  } catch (error) {
    stage.dispose();
    throw error;
  }
  let before = begin;
  return {
    canvas: stage.canvas,
    drawAt: (seconds) => {
      stage.drawAt(seconds, seconds - before);
      before = seconds;
    },
    dispose: () => stage.dispose(),
  };
}
