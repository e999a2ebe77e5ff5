import { Color } from 'three';
import type { SolvedMotion } from '../../motion/skeleton/clip';
import { createRibbons } from './ribbons';
import { MOST_FIGURES, type Show } from './overlay';
import { tipAt, TIPS, tipTracks } from './end-effectors';

/** How long a hand or foot is remembered, seconds. */
export const TRAIL_SECONDS = 1.5;
/** Points a second, on a fixed beat of the dance, so that a trail does not shimmer as it grows. */
const POINTS_PER_SECOND = 60;
const POINTS = Math.ceil(TRAIL_SECONDS * POINTS_PER_SECOND) + 2;
/** Half widths at the limb and at the end, metres. */
const WIDE = 0.015;
const THIN = 0.002;

/** Where hands and feet have just been: bands that grow thin and faint. */
export function createTrails(): Show {
  const ribbons = createRibbons(MOST_FIGURES * TIPS, POINTS, false);
  const colours = { leader: new Color(), reactor: new Color() };
  const tracks = new WeakMap<SolvedMotion, Float32Array>();
  const tracksOf = (motion: SolvedMotion): Float32Array => {
    const known = tracks.get(motion) ?? tipTracks(motion);
    tracks.set(motion, known);
    return known;
  };
  const place = { x: 0, y: 0, z: 0 };

  return {
    object: ribbons.object,
    update(figures, seconds) {
      ribbons.clear();
      for (const { role, motion } of figures) {
        const end = Math.min(seconds, (motion.frames - 1) / motion.fps);
        const start = Math.max(0, end - TRAIL_SECONDS);
        for (let tip = 0; tip < TIPS; tip++) {
          ribbons.begin();
          const point = (moment: number): void => {
            const fresh = 1 - (end - moment) / TRAIL_SECONDS;
            tipAt(tracksOf(motion), tip, moment * motion.fps, place);
            const width = THIN + (WIDE - THIN) * fresh;
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
