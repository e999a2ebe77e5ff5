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
const POINTS = 17;
/** Half width of the line, and radius of the bead on each wrist, metres. */
const HALF_WIDTH = 0.006;
const BEAD_RADIUS = 0.021;
/** Height of the line's arc above a straight line, as a share of its length. */
const ARC = 0.14;

/** Lines between hands that are near each other, from the leader's colour to the reactor's. */
export function createHandLinks(): Overlay {
  const lines = createRibbons(MAX_HAND_PAIRS, POINTS, true);
  const material = new MeshBasicMaterial({ depthTest: false, depthWrite: false, transparent: true });
  const beads = new InstancedMesh(new IcosahedronGeometry(BEAD_RADIUS, 2), material, MAX_HAND_PAIRS * 2);
  beads.instanceMatrix.setUsage(DynamicDrawUsage);
  beads.frustumCulled = false;
  beads.renderOrder = 21;
  const object = new Group();
  object.add(lines.object, beads);

  const colours = { leader: new Color(), reactor: new Color(), middle: new Color(), mixed: new Color() };
  const between = (t: number): Color =>
    t < 0.5
      ? colours.mixed.lerpColors(colours.leader, colours.middle, t * 2)
      : colours.mixed.lerpColors(colours.middle, colours.reactor, t * 2 - 1);

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
          bead(leader.joints, pair.leader, pair.opacity, colours.middle);
          bead(reactor.joints, pair.reactor, pair.opacity, colours.middle);
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
