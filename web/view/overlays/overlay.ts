import type { Role } from '../../common/role';
import type { Object3D } from 'three';
import type { SolvedMotion } from '../../motion/skeleton/clip';
import type { Look } from '../theme';

/** A dancer as an overlay sees them: role, the whole motion, and the 22 x 3 joint positions of this moment in metres. */
export interface Figure {
  readonly role: Role;
  readonly motion: SolvedMotion;
  readonly joints: Float32Array;
}

/** At most this many dancers have overlays in one viewport. */
export const MAX_FIGURES = 2;

/** Something drawn about the dancers beside the dancers themselves. It depends on the moment only, not on earlier frames. */
export interface Overlay {
  readonly object: Object3D;
  /** Shows this moment of these dancers, the leader first. */
  update(figures: readonly Figure[], seconds: number): void;
  setLook(look: Look): void;
  dispose(): void;
}
