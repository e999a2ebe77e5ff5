import { createBlockRow } from './block-row';
import { dancers, generatedRole } from '../store/roles';
import { el, setText, setVariable, together } from '../widgets/dom';
import { mountLaneZoom } from './lane-zoom';
import { mountLoopRegion } from './loop-region';
import { createMotionLane, type DrawnMotion, drawnMotion, type MotionPicture } from './motion-lane';
import { createPlayhead } from './playhead';
import { rulerMarks } from './ruler';
import { isReading, danceFps, jobWords, upToDate } from '../store/selectors';
import type { Services } from '../store/services';
import { createSongLabel } from './song-label';
import { createSongLane } from './song-lane';
import { musicBeats } from '../store/song-shift';
import type { AppState } from '../store/state';
import { type Store, watch, watchAll } from '../store/store';
import { visibleSpan } from '../store/actions/timeline';
import { type Span, timeScale, type TimeScale } from '../store/time-scale';

/** Speed that a lane's upper edge stands for at least, m/s, so that standing still looks still. */
const LEAST_TOP = 1;
/** Room above the fastest usual moment. */
const HEADROOM = 1.2;

/** Puts lanes of its own below the others; `shown` is the part of the dance that the lanes show. */
export type MountLanes = (
  lanes: HTMLElement,
  store: Store,
  services: Services,
  shown: (state: AppState) => Span,
) => () => void;

/** The score: ruler, song, leader and reactor over the same seconds, more lanes below, loop and playhead across them. */
export const mountTimeline = (
  root: HTMLElement,
  store: Store,
  services: Services,
  mountMoreLanes: MountLanes,
): (() => void) => {
  const ruler = el('div', { class: 'lane ruler', attributes: { 'data-own-pointer': true } });
  ruler.title = 'Drag to loop a part, click to jump';
  const rulerMarksRoot = el('div', { class: 'marks', attributes: { 'aria-hidden': 'true' } });
  ruler.append(rulerMarksRoot);
  const rulerName = el('div', { class: 'lab ruler' });
  const scale = (): TimeScale => timeScale(visibleSpan(store.getState()), reactorLane.root.clientWidth);

  /** The shift of the song while it is being dragged, frames. */
  let tried: number | null = null;
  const songLabel = createSongLabel(store);
  const songLane = createSongLane(store, services, {
    scale,
    onTry: (shift) => {
      tried = shift;
      redrawSoon();
    },
  });
  const leaderLane = createMotionLane('leader', 'lane mot lead-lane', el('div', { class: 'base' }));
  const blocks = createBlockRow();
  const reactorLane = createMotionLane('reactor', 'lane mot', blocks.root);
  const lanes = el(
    'div',
    { class: 'lanes' },
    rulerName,
    ruler,
    songLabel.root,
    songLane.root,
    el('div', { class: 'lab mot lead-lane lead' }, el('span', { class: 'dot' }), 'Leader'),
    leaderLane.root,
    el('div', { class: 'lab mot reac' }, el('span', { class: 'dot' }), 'Reactor'),
    reactorLane.root,
  );
  root.append(lanes);
  const moreLanes = mountMoreLanes(lanes, store, services, visibleSpan);
  const playhead = createPlayhead(lanes, store, services, scale);
  lanes.append(playhead.root);
  const loop = mountLoopRegion(store, services, { ruler, overlay: playhead.root, scale });

  let leader: DrawnMotion | null = null;
  let reactor: DrawnMotion | null = null;
  /** The speed at the upper edge of both lanes, so that the two can be compared. */
  let top = LEAST_TOP;
  const measure = (): void => {
    const speeds = [...(leader?.speed ?? []), ...(reactor?.speed ?? [])];
    top = Math.max(LEAST_TOP, HEADROOM * usualMost(speeds));
  };

  const drawRuler = (beats: readonly number[], now: TimeScale): void => {
    const { name, marks } = rulerMarks(beats, now);
    setText(rulerName, name);
    rulerMarksRoot.replaceChildren(
      ...marks.map(({ text, at }) => {
        const mark = el('span', { text });
        setVariable(mark, '--at', at);
        return mark;
      }),
    );
  };
  const drawWords = (state: AppState): void => {
    const leads = generatedRole(state) === 'leader';
    const [made, loaded] = leads ? [leaderLane, reactorLane] : [reactorLane, leaderLane];
    const waiting = state.leader && !state.reaction;
    loaded.say(state.leader ? '' : state.reading.leader ? 'Reading the leader' : 'No leader yet');
    made.say(waiting ? (state.job ? capital(jobWords(state.job, state)) : 'Not made yet') : '');
  };
  const redraw = (): void => {
    const state = store.getState();
    const now = scale();
    const shift = tried ?? state.shift;
    const beats = musicBeats({ ...state, shift });
    const tolerance = state.manifest?.quality.beats.tolerance ?? 0;
    const still = { scale: now, musicBeats: beats, tolerance, top, stale: false, fresh: null };
    drawRuler(beats, now);
    songLabel.show(state);
    songLane.draw(state, { scale: now, shift, musicBeats: beats });
    songLane.played(state.playback.time, now);
    const { job } = state;
    const fps = danceFps(state);
    const made: MotionPicture = {
      ...still,
      stale: job !== null && !upToDate(state),
      fresh: job?.previewed ? { from: job.previewed.from / fps, to: job.previewed.to / fps } : null,
    };
    const leads = generatedRole(state) === 'leader';
    leaderLane.draw(leader, leads ? made : still);
    reactorLane.draw(reactor, leads ? still : made);
    const lane = leads ? leaderLane : reactorLane;
    if (blocks.root.parentElement !== lane.root) lane.root.prepend(blocks.root);
    blocks.draw(state, now);
    drawWords(state);
    loop.draw();
    playhead.draw();
  };
  let frame = 0;
  /** Draws once before the next picture, however much changed. */
  const redrawSoon = (): void => {
    cancelAnimationFrame(frame);
    frame = requestAnimationFrame(redraw);
  };
  const sizes = new ResizeObserver(redraw);
  sizes.observe(lanes);

  return together(
    watchAll(
      store,
      (state) => [dancers(state).leader, state.manifest],
      (state) => {
        const motion = dancers(state).leader;
        leader = motion && drawnMotion(motion, state.manifest);
        measure();
      },
    ),
    watchAll(
      store,
      (state) => [dancers(state).reactor, state.manifest],
      (state) => {
        const motion = dancers(state).reactor;
        reactor = motion && drawnMotion(motion, state.manifest);
        measure();
      },
    ),
    watchAll(
      store,
      (state) => [
        ...[state.leader, state.song, state.shift, ...Object.values(dancers(state)), state.manifest],
        ...[state.zoom, state.theme, generatedRole(state), ...isReading(state)],
        ...[state.job !== null, state.job?.previewed?.from, state.job?.previewed?.to, upToDate(state)],
      ],
      redrawSoon,
    ),
    watch(
      store,
      (state) => state.job,
      (_, state) => {
        blocks.fill(state);
        drawWords(state);
      },
    ),
    watch(
      store,
      (state) => state.playback.time,
      (time) => {
        songLane.played(time, scale());
      },
    ),
    mountLaneZoom(store, lanes, playhead.root, scale),
    loop.dispose,
    playhead.dispose,
    moreLanes,
    songLane.dispose,
    () => {
      cancelAnimationFrame(frame);
      sizes.disconnect();
      lanes.remove();
    },
  );
};

/** The speed that only one moment in fifty exceeds: a single hasty turn must not flatten all the rest. */
function usualMost(speeds: number[]): number {
  return speeds.sort((a, b) => a - b)[Math.floor(speeds.length * 0.98)] ?? 0;
}

function capital(text: string): string {
  return text.charAt(0).toUpperCase() + text.slice(1);
}
