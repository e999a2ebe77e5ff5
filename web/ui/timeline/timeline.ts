import { type Role, ROLES } from '../../common/role';
import { onPixelSize } from '../../common/pixel-size';
import type { SolvedMotion } from '../../motion/skeleton/clip';
import { DancerLanes } from './lanes/dancer-lanes';
import { reactorMotion } from '../store/reactor-motion';
import { generatedRole } from '../store/roles';
import { countedBeats } from '../store/counting';
import { el } from '../widgets/dom';
import { mountLaneZoom } from './lane-zoom';
import { LoopRegion } from './loop-region';
import { Playhead } from './playhead';
import { createRulerLane } from './ruler';
import { isReading, isSampling } from '../store/selectors';
import type { Mount, Services } from '../store/services';
import { createSongLabel } from './song-label';
import { SongLane } from './lanes/song-lane';
import { musicBeats } from '../store/song-shift';
import type { AppState } from '../store/state';
import { type Store, watch, watchAll } from '../store/store';
import { visibleSpan } from '../store/actions/timeline';
import { timeScale, type TimeScale } from '../store/time-scale';

/**
 * The timeline: ruler, song, leader and reactor over the same seconds, more lanes below in the given order, loop region and playhead
 * across all of them.
 * @param moreLanes put lanes of their own below the others
 */
export function mountTimeline(
  root: HTMLElement,
  store: Store,
  services: Services,
  moreLanes: readonly Mount[],
): void {
  const scale = (): TimeScale => timeScale(visibleSpan(store.getState()), dancers.width);
  /** The shift of the song while it is being dragged, frames. */
  let draggedShift: number | null = null;
  const ruler = createRulerLane();
  const songLane = new SongLane(store, services, {
    scale,
    onDragShift: (shift) => {
      draggedShift = shift;
      redraw();
    },
  });
  const songLabel = createSongLabel(store, songLane.handle);
  const dancers = new DancerLanes();
  const lanes = el(
    'div',
    { class: 'lanes' },
    ...[ruler.label, ruler.root, songLabel.root, songLane.root, ...dancers.elements],
  );
  root.append(lanes);
  for (const mount of moreLanes) mount(lanes, store, services);
  const playhead = new Playhead(lanes, store, services, scale);
  const overlay = el('div', { class: 'loop-place' });
  lanes.append(playhead.root, overlay);
  const loop = new LoopRegion(store, services, {
    ruler: ruler.root,
    playhead: playhead.root,
    overlay,
    scale,
  });

  const draw = (): void => {
    const state = store.getState();
    const now = scale();
    const shift = draggedShift ?? state.shift;
    const beats = countedBeats({ ...state, shift });
    ruler.draw(beats, now);
    songLabel.show(state);
    songLane.draw(state, { scale: now, shift, beats });
    songLane.showPlayed(state.playback.time, now);
    dancers.draw(state, now, musicBeats({ ...state, shift }));
    loop.draw();
    playhead.draw();
  };
  const redraw = oncePerFrame(draw);
  onPixelSize(lanes, draw);
  followMotions(store, dancers);
  watchAll(store, drawnParts, redraw);
  watch(
    store,
    (state) => state.job,
    (_, state) => {
      dancers.showProgress(state);
    },
  );
  followSettingOne(store, lanes);
  watch(
    store,
    (state) => state.playback.time,
    (time) => {
      songLane.showPlayed(time, scale());
    },
  );
  mountLaneZoom(store, lanes, playhead.root, scale);
}

/** Marks the lanes while the next click says where the "1" is. */
function followSettingOne(store: Store, lanes: HTMLElement): void {
  watch(
    store,
    (state) => state.settingOne,
    (on) => {
      lanes.classList.toggle('setting-one', on);
    },
  );
}

/** Hands the motions of both dancers to their lanes. */
function followMotions(store: Store, lanes: DancerLanes): void {
  for (const role of ROLES)
    watchAll(
      store,
      (state) => [laneMotion(state, role), state.manifest],
      (state) => {
        lanes.setMotion(role, laneMotion(state, role), state.manifest);
      },
    );
}

/** The motion that a lane shows: of the generated dancer the finished one, since a preview is there for a moment. */
function laneMotion(state: AppState, role: Role): SolvedMotion | null {
  return role === generatedRole(state) ? reactorMotion(state) : (state.leader?.motion ?? null);
}

/** The parts of the state that the drawn lanes depend on. */
function drawnParts(state: AppState): readonly unknown[] {
  return [
    ...[state.leader, state.song, state.shift, state.countings, reactorMotion(state), state.manifest],
    ...[state.zoom, state.theme, generatedRole(state), ...isReading(state)],
    isSampling(state),
  ];
}

/** A function that runs `draw` before the next frame of the page, once however often it is called. */
function oncePerFrame(draw: () => void): () => void {
  let frame = 0;
  return () => {
    cancelAnimationFrame(frame);
    frame = requestAnimationFrame(draw);
  };
}
