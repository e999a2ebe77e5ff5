import {
  Color,
  DynamicDrawUsage,
  Group,
  IcosahedronGeometry,
  InstancedMesh,
  Matrix4,
  MeshBasicMaterial,
} from 'three';
import { holds, MOST_HOLDS, type Hold } from './hands-within-reach';
import { createRibbons } from './ribbons';
import type { Show } from './overlay';

const POINTS = 17;
/** Half width of the line, and radius of the bead on each wrist, metres. */
const WIDE = 0.006;
const BEAD = 0.021;
/** How far the line bows upwards, as a share of its length. */
const BOW = 0.14;

/** Lines between hands that hold or nearly hold each other, from the leader's colour to the reactor's. */
export function createHandLinks(): Show {
  const lines = createRibbons(MOST_HOLDS, POINTS, true);
  const material = new MeshBasicMaterial({ depthTest: false, depthWrite: false, transparent: true });
  const beads = new InstancedMesh(new IcosahedronGeometry(BEAD, 2), material, MOST_HOLDS * 2);
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

  function draw(a: Float32Array, b: Float32Array, { leader, reactor, gap, strength }: Hold): void {
    lines.begin();
    for (let i = 0; i < POINTS; i++) {
      const t = i / (POINTS - 1);
      const at = (axis: number): number => a[leader * 3 + axis]! * (1 - t) + b[reactor * 3 + axis]! * t;
      lines.point(at(0), at(1) + BOW * gap * 4 * t * (1 - t), at(2), WIDE, between(t), strength);
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
        for (const hold of holds(leader.joints, reactor.joints)) {
          draw(leader.joints, reactor.joints, hold);
          bead(leader.joints, hold.leader, hold.strength, colours.middle);
          bead(reactor.joints, hold.reactor, hold.strength, colours.middle);
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
