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
import { SOLE } from '../body/leg';
import { headingOf } from '../../motion/skeleton/heading';
import { MOST_FIGURES, type Show } from './overlay';

/** The arrow begins this far in front of the root and ends there, metres. */
const START = 0.2;
const END = 0.58;
const HEAD = 0.17;
/** Half widths of the shaft and of the head, metres. */
const SHAFT = 0.024;
const BARB = 0.09;
const OPACITY = 0.95;

/** An arrow along +z that grows out of nothing. */
function arrow(): ShapeGeometry {
  const neck = END - HEAD;
  const shape = new Shape();
  // Drawn in the plane of x and -z, which laying it on the floor turns into x and z.
  const points: [number, number][] = [
    [-SHAFT * 0.4, START],
    [-SHAFT, neck],
    [-BARB, neck - 0.02],
    [0, END],
    [BARB, neck - 0.02],
    [SHAFT, neck],
    [SHAFT * 0.4, START],
  ];
  points.forEach(([x, z], i) => (i === 0 ? shape.moveTo(x, -z) : shape.lineTo(x, -z)));
  const geometry = new ShapeGeometry(shape).rotateX(-Math.PI / 2);
  const { position } = geometry.attributes;
  const paint = new Float32Array(position!.count * 4).fill(1);
  for (let v = 0; v < position!.count; v++)
    paint[v * 4 + 3] = OPACITY * Math.min(1, 0.25 + (position!.getZ(v) - START) / (neck - START));
  geometry.setAttribute('color', new BufferAttribute(paint, 4));
  return geometry;
}

/** Arrows on the floor that show where each dancer faces. */
export function createFacing(): Show {
  const material = new MeshBasicMaterial({
    vertexColors: true,
    transparent: true,
    depthWrite: false,
    side: DoubleSide,
  });
  const object = new InstancedMesh(arrow(), material, MOST_FIGURES);
  object.instanceMatrix.setUsage(DynamicDrawUsage);
  object.frustumCulled = false;
  object.renderOrder = 3;
  const colours = { leader: new Color(), reactor: new Color() };
  const place = new Matrix4();
  return {
    object,
    update(figures) {
      figures.forEach(({ role, joints }, i) => {
        place.makeRotationY(headingOf(joints)).setPosition(joints[0]!, -SOLE + 0.008, joints[2]!);
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
