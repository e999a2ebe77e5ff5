import { otherRole, type Role, ROLES } from '../../../common/role';
import type { SolvedMotion } from '../../../motion/skeleton/clip';
import type { Manifest } from '../../../model/client';
import { createBlockRow } from '../block-row';
import { createMotionLane, type DrawnMotion, drawnMotion, type MotionLaneView } from './motion-lane';
import { generatedRole } from '../../store/roles';
import { capitalised } from '../../store/format';
import { isSampling, jobText } from '../../store/selectors';
import type { AppState } from '../../store/state';
import type { TimeScale } from '../../store/time-scale';
import { el } from '../../widgets/dom';

/** Speed that the upper edge of a lane stands for at least, m/s, so that standing still looks still. */
const MIN_TOP_SPEED = 1;
/** Speed of the upper edge divided by the fastest usual speed. */
const HEADROOM = 1.2;
/** Share of the frames whose speeds are usual: a single quick turn must not flatten all the rest. */
const USUAL_SHARE = 0.98;

/** The lanes of leader and reactor on one scale of speed, and the blocks of the model under the generated one. */
export class DancerLanes {
  readonly #blocks = createBlockRow();
  readonly #lanes = {
    leader: createMotionLane('leader', 'lane motion leader-lane', el('div', { class: 'base' })),
    reactor: createMotionLane('reactor', 'lane motion', this.#blocks.root),
  };
  readonly #motions: Record<Role, DrawnMotion | null> = { leader: null, reactor: null };
  /** Motions that came since the last `draw`: finding their beats can wait until then. */
  readonly #newMotions = new Map<Role, () => DrawnMotion | null>();
  /** Speed at the upper edge of both lanes, m/s. */
  #topSpeed = MIN_TOP_SPEED;

  /** Labels and lanes, in the order of the grid. */
  readonly elements: readonly HTMLElement[] = [
    el('div', { class: 'lane-label motion leader-lane leader' }, el('span', { class: 'dot' }), 'Leader'),
    this.#lanes.leader.root,
    el('div', { class: 'lane-label motion reactor' }, el('span', { class: 'dot' }), 'Reactor'),
    this.#lanes.reactor.root,
  ];

  /** Width of a lane, CSS pixels. */
  get width(): number {
    return this.#lanes.reactor.root.clientWidth;
  }

  /** Takes another motion, which the next `draw` shows. */
  setMotion(role: Role, motion: SolvedMotion | null, manifest: Manifest | null): void {
    this.#newMotions.set(role, () => motion && drawnMotion(motion, manifest));
  }

  /** @param musicBeats seconds of the dance */
  draw(state: AppState, scale: TimeScale, musicBeats: readonly number[]): void {
    this.#takeNewMotions();
    const made = generatedRole(state);
    const loadedView: MotionLaneView = {
      scale,
      musicBeats,
      tolerance: state.manifest?.quality.beats.tolerance ?? 0,
      top: this.#topSpeed,
      stale: false,
    };
    const madeView: MotionLaneView = { ...loadedView, stale: isSampling(state) };
    for (const role of ROLES)
      this.#lanes[role].draw(this.#motions[role], role === made ? madeView : loadedView);
    const { root } = this.#lanes[made];
    if (this.#blocks.root.parentElement !== root) root.prepend(this.#blocks.root);
    this.#blocks.draw(state, scale);
    this.#showText(state);
  }

  #takeNewMotions(): void {
    if (this.#newMotions.size === 0) return;
    for (const [role, read] of this.#newMotions) this.#motions[role] = read();
    this.#newMotions.clear();
    this.#topSpeed = Math.max(MIN_TOP_SPEED, HEADROOM * usualTopSpeed(Object.values(this.#motions)));
  }

  /** Shows how far the job has come. */
  showProgress(state: AppState): void {
    this.#blocks.fill(state);
    this.#showText(state);
  }

  /** Shows a text in each lane without a motion. */
  #showText(state: AppState): void {
    const { leader, reading, reaction, job } = state;
    const made = generatedRole(state);
    this.#lanes[otherRole(made)].showMessage(
      leader ? '' : reading.leader ? 'Reading the leader' : 'No leader yet',
    );
    const waiting = job ? capitalised(jobText(job, state)) : 'Not made yet';
    this.#lanes[made].showMessage(leader && !reaction ? waiting : '');
  }
}

/** The largest of the usual speeds, m/s. */
function usualTopSpeed(motions: readonly (DrawnMotion | null)[]): number {
  const speeds = Float32Array.from(motions.flatMap((motion) => (motion ? [...motion.speed] : []))).sort();
  return speeds[Math.floor(speeds.length * USUAL_SHARE)] ?? 0;
}
