/** From the state to a stage: what is danced, seen and filmed. */
import { dancers, generatedRole } from './ui/store/roles';
import { besideStage } from './ui/generation/coarse-layer';
import { together } from './ui/widgets/dom';
import type { Camera } from './ui/download/downloads';
import { coarseMotion, otherCoarseMotion } from './ui/store/reactor-motion';
import { type Store, watch, watchAll } from './ui/store/store';
import { showOther } from './ui/takes/other-dancer';
import type { PictureSize, Stage } from './view/stage';

const calm = matchMedia('(prefers-reduced-motion: reduce)');

/** Milliseconds after a dance was made in which it is put on the page and measured. */
const AFTERMATH = 1000;

/** Shows on a stage what the state says; returns how to let go of it. */
export function showOn(shown: Stage, store: Store): () => void {
  let shownAs = '';
  let calming: ReturnType<typeof setTimeout> | undefined;
  return together(
    watch(
      store,
      (state) => state.theme,
      (theme) => shown.setTheme(theme),
    ),
    watchAll(
      store,
      (state) => Object.values(dancers(state)),
      (state) => {
        // One reaction passes over into the next; what is switched is there at once: the parts, the foot lock, and
        // which of two takes side by side is on the stage, each of which goes on in its half.
        const half = besideStage(state) && state.letter;
        const now = `${generatedRole(state)} ${state.footLock} ${half}`;
        shown.setDancers(dancers(state), {
          made: generatedRole(state),
          softly: now === shownAs && !calm.matches,
        });
        shownAs = now;
      },
    ),
    watchAll(
      store,
      (state) => [coarseMotion(state), otherCoarseMotion(state)],
      (state) => shown.setCoarse(coarseMotion(state), otherCoarseMotion(state)),
    ),
    watch(
      store,
      (state) => state.overlays,
      (what) => shown.setShown(what),
    ),
    showOther(store, shown),
    watch(
      store,
      (state) => state.job !== null,
      (busy) => {
        clearTimeout(calming);
        if (busy) shown.setPatient(true);
        else calming = setTimeout(() => shown.setPatient(false), AFTERMATH);
      },
    ),
    () => clearTimeout(calming),
    watch(
      store,
      (state) => state.playback.time,
      (time) => shown.setTime(time),
    ),
    watch(
      store,
      (state) => state.camera,
      (camera) => shown.setCamera(camera),
    ),
  );
}

/** Windows that are wide enough for the dancers beside the words of the first visit. */
const WIDE = matchMedia('(min-width: 761px)');
const ASIDE_PX = 200;

/** Moves the dancers beside the words of the first visit, where there is room; returns how to let go of it. */
export function standAside(stage: Stage, store: Store): () => void {
  return watch(
    store,
    (state) => state.firstVisit,
    (firstVisit) => {
      stage.standAside(firstVisit && WIDE.matches ? ASIDE_PX : 0);
    },
  );
}

/** A stage of its own for a video: as the stage is now, from the start of the dance; nothing disturbs it later. */
export async function openCamera(from: Stage, store: Store, size: PictureSize): Promise<Camera> {
  const film = from.film(size);
  try {
    showOn(film, store)();
    const framing = from.framing();
    await film.ready();
    film.setTime(0);
    film.frameAs(framing);
  } catch (error) {
    film.dispose();
    throw error;
  }
  let before = 0;
  return {
    canvas: film.canvas,
    shoot: (seconds) => {
      film.shoot(seconds, seconds - before);
      before = seconds;
    },
    dispose: () => film.dispose(),
  };
}
