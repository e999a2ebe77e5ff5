import { smoothstep } from '../../motion/math/vec3';
import {
  Color,
  DynamicDrawUsage,
  Group,
  IcosahedronGeometry,
  InstancedMesh,
  Matrix4,
  MeshBasicMaterial,
} from 'three';
import { nearHandPairs, MAX_HAND_PAIRS, type HandPair } from './hand-pairs';
import { createRibbons } from './ribbons';
import type { Overlay } from './overlay';

/** Points along a line. */
const POINTS = 25;
/** Half width of the line, and radii of the dot on each wrist and of the edge around it, metres. */
const HALF_WIDTH = 0.006;
const DOT_RADIUS = 0.015;
const EDGE_RADIUS = 0.021;
/** Height of the line's arc above a straight line, as a share of its length. */
const ARC = 0.14;
/** Share of the line at each end in the colour of that dancer, and share in the middle that is light. */
const END = 0.16;
const MIDDLE = 0.12;

/** Arcs between hands that are near each other: in the leader's colour, light in the middle, in the reactor's colour. */
export function createHandLinks(): Overlay {
  const lines = createRibbons(MAX_HAND_PAIRS, POINTS, true);
  const material = new MeshBasicMaterial({ depthTest: false, depthWrite: false, transparent: true });
  const beads = new InstancedMesh(new IcosahedronGeometry(1, 2), material, MAX_HAND_PAIRS * 4);
  beads.instanceMatrix.setUsage(DynamicDrawUsage);
  beads.frustumCulled = false;
  beads.renderOrder = 21;
  const object = new Group();
  object.add(lines.object, beads);

  const colours = { leader: new Color(), reactor: new Color(), middle: new Color(), mixed: new Color() };
  const between = (t: number): Color => {
    const fromEnd = smoothstep(END, 0.5 - MIDDLE / 2, Math.min(t, 1 - t));
    return colours.mixed.lerpColors(t < 0.5 ? colours.leader : colours.reactor, colours.middle, fromEnd);
  };

  function draw(a: Float32Array, b: Float32Array, { leader, reactor, distance, opacity }: HandPair): void {
    lines.begin();
    for (let i = 0; i < POINTS; i++) {
      const t = i / (POINTS - 1);
      const at = (axis: number): number => a[leader * 3 + axis]! * (1 - t) + b[reactor * 3 + axis]! * t;
      lines.point(at(0), at(1) + ARC * distance * 4 * t * (1 - t), at(2), HALF_WIDTH, between(t), opacity);
    }
  }
  const place = new Matrix4();
  let count = 0;
  function bead(joints: Float32Array, wrist: number, size: number, colour: Color): void {
    place.makeScale(size, size, size);
    beads.setMatrixAt(
      count,
      place.setPosition(joints[wrist * 3]!, joints[wrist * 3 + 1]!, joints[wrist * 3 + 2]!),
    );
    beads.setColorAt(count++, colour);
  }

  return {
    object,
    update([leader, reactor]) {
      lines.clear();
      count = 0;
      if (leader && reactor)
        for (const pair of nearHandPairs(leader.joints, reactor.joints)) {
          draw(leader.joints, reactor.joints, pair);
          for (const [{ joints, role }, wrist] of [
            [leader, pair.leader],
            [reactor, pair.reactor],
          ] as const) {
            // Nothing hides a dot, so that the one that is drawn later lies on top.
            bead(joints, wrist, EDGE_RADIUS * pair.opacity, colours.middle);
            bead(joints, wrist, DOT_RADIUS * pair.opacity, colours[role]);
          }
        }
      lines.commit();
      beads.count = count;
      beads.visible = count > 0;
      beads.instanceMatrix.needsUpdate = true;
      if (beads.instanceColor) beads.instanceColor.needsUpdate = true;
    },
    setLook(look) {
      colours.leader.set(look.leader);
      colours.reactor.set(look.reactor);
      colours.middle.set(look.contrast);
    },
    dispose() {
      lines.dispose();
      beads.geometry.dispose();
      beads.dispose();
      material.dispose();
    },
  };
}
