import { Color } from 'three';
import type { SolvedMotion } from '../../motion/skeleton/clip';
import { createRibbons } from './ribbons';
import { MAX_FIGURES, type Overlay } from './overlay';
import { endEffectorAt, END_EFFECTORS, endEffectorTracks } from './end-effectors';

/** Duration of a trail, seconds. */
export const TRAIL_SECONDS = 1.5;
/** Points a second, at fixed moments of the motion, so that a trail does not flicker as it grows. */
const POINTS_PER_SECOND = 60;
const POINTS = Math.ceil(TRAIL_SECONDS * POINTS_PER_SECOND) + 2;
/** Half widths at the hand or foot and at the end, metres. */
const START_WIDTH = 0.015;
const END_WIDTH = 0.002;

/** Where hands and feet have just been: ribbons that become thin and transparent. */
export function createTrails(): Overlay {
  const ribbons = createRibbons(MAX_FIGURES * END_EFFECTORS, POINTS, false);
  const colours = { leader: new Color(), reactor: new Color() };
  const tracks = new WeakMap<SolvedMotion, Float32Array>();
  const tracksOf = (motion: SolvedMotion): Float32Array => {
    const found = tracks.get(motion) ?? endEffectorTracks(motion);
    tracks.set(motion, found);
    return found;
  };
  const place = { x: 0, y: 0, z: 0 };

  return {
    object: ribbons.object,
    update(figures, seconds) {
      ribbons.clear();
      for (const { role, motion } of figures) {
        const end = Math.min(seconds, (motion.frames - 1) / motion.fps);
        const start = Math.max(0, end - TRAIL_SECONDS);
        for (let effector = 0; effector < END_EFFECTORS; effector++) {
          ribbons.begin();
          const point = (moment: number): void => {
            const fresh = 1 - (end - moment) / TRAIL_SECONDS;
            endEffectorAt(tracksOf(motion), effector, moment * motion.fps, place);
            const width = END_WIDTH + (START_WIDTH - END_WIDTH) * fresh;
            ribbons.point(place.x, place.y, place.z, width, colours[role], 0.9 * fresh ** 1.3);
          };
          point(end);
          for (let k = Math.ceil(end * POINTS_PER_SECOND) - 1; k / POINTS_PER_SECOND > start; k--)
            point(k / POINTS_PER_SECOND);
          point(start);
        }
      }
      ribbons.commit();
    },
    setLook(look) {
      colours.leader.set(look.leader);
      colours.reactor.set(look.reactor);
    },
    dispose() {
      ribbons.dispose();
    },
  };
}
