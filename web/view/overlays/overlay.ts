import type { Object3D } from 'three';
import type { SolvedMotion } from '../../motion/skeleton/clip';
import type { Look, Role } from '../theme';

/** A dancer as a show sees them: whose part, the whole dance, and the 22 x 3 joints of this moment in metres. */
export interface Figure {
  readonly role: Role;
  readonly motion: SolvedMotion;
  readonly joints: Float32Array;
}

/** At most this many dancers are in one picture. */
export const MOST_FIGURES = 2;

/** Something drawn about the dancers beside the dancers themselves. It follows from the moment alone, not from the past. */
export interface Show {
  readonly object: Object3D;
  /** Shows this moment of these dancers, the leader first. */
  update(figures: readonly Figure[], seconds: number): void;
  setLook(look: Look): void;
  dispose(): void;
}
