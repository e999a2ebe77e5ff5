import {
  BufferAttribute,
  Color,
  DynamicDrawUsage,
  InstancedMesh,
  Matrix4,
  DoubleSide,
  MeshBasicMaterial,
  Shape,
  ShapeGeometry,
} from 'three';
import { headingOf } from '../../motion/skeleton/heading';
import { MAX_FIGURES, type Overlay } from './overlay';

/** Distances in front of the root at which the arrow begins and ends, metres. */
const START = 0.2;
const END = 0.58;
const HEAD_LENGTH = 0.17;
/** Half widths of the shaft and of the head, metres. */
const SHAFT_HALF_WIDTH = 0.024;
const HEAD_HALF_WIDTH = 0.09;
const OPACITY = 0.95;

/** An arrow along +z that fades in from its beginning. */
function arrow(): ShapeGeometry {
  const neck = END - HEAD_LENGTH;
  const shape = new Shape();
  // Drawn in the plane of x and -z, which laying it on the floor turns into x and z.
  const points: [number, number][] = [
    [-SHAFT_HALF_WIDTH * 0.4, START],
    [-SHAFT_HALF_WIDTH, neck],
    [-HEAD_HALF_WIDTH, neck - 0.02],
    [0, END],
    [HEAD_HALF_WIDTH, neck - 0.02],
    [SHAFT_HALF_WIDTH, neck],
    [SHAFT_HALF_WIDTH * 0.4, START],
  ];
  points.forEach(([x, z], i) => (i === 0 ? shape.moveTo(x, -z) : shape.lineTo(x, -z)));
  const geometry = new ShapeGeometry(shape).rotateX(-Math.PI / 2);
  const { position } = geometry.attributes;
  const rgba = new Float32Array(position!.count * 4).fill(1);
  for (let v = 0; v < position!.count; v++)
    rgba[v * 4 + 3] = OPACITY * Math.min(1, 0.25 + (position!.getZ(v) - START) / (neck - START));
  geometry.setAttribute('color', new BufferAttribute(rgba, 4));
  return geometry;
}

/** Arrows on the floor that show where each dancer is facing. */
export function createFacing(): Overlay {
  const material = new MeshBasicMaterial({
    vertexColors: true,
    transparent: true,
    depthWrite: false,
    side: DoubleSide,
  });
  const object = new InstancedMesh(arrow(), material, MAX_FIGURES);
  object.instanceMatrix.setUsage(DynamicDrawUsage);
  object.frustumCulled = false;
  object.renderOrder = 3;
  const colours = { leader: new Color(), reactor: new Color() };
  const place = new Matrix4();
  return {
    object,
    update(figures) {
      figures.forEach(({ role, joints }, i) => {
        place.makeRotationY(headingOf(joints)).setPosition(joints[0]!, 0.008, joints[2]!);
        object.setMatrixAt(i, place);
        object.setColorAt(i, colours[role]);
      });
      object.count = figures.length;
      object.instanceMatrix.needsUpdate = true;
      if (object.instanceColor) object.instanceColor.needsUpdate = true;
    },
    setLook(look) {
      colours.leader.set(look.leader);
      colours.reactor.set(look.reactor);
    },
    dispose() {
      object.geometry.dispose();
      material.dispose();
      object.dispose();
    },
  };
}
