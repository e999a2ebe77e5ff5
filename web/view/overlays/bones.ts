import {
  Color,
  DynamicDrawUsage,
  Group,
  IcosahedronGeometry,
  InstancedMesh,
  Matrix4,
  MeshStandardMaterial,
  OctahedronGeometry,
  Quaternion,
  Vector3,
} from 'three';
import { JOINT_COUNT, PARENTS } from '../../motion/skeleton/skeleton';
import { MAX_FIGURES, type Overlay } from './overlay';

/** Radii of a joint and of a bone at its thickest, metres. */
const JOINT_RADIUS = 0.019;
const BONE_RADIUS = 0.02;
/** Where along its length a bone is thickest, 0 to 1. */
const BULGE = 0.18;

/** A spindle from the origin to (0, 1, 0), thickest near its beginning. */
function spindle(): OctahedronGeometry {
  const geometry = new OctahedronGeometry(1, 0);
  const { position } = geometry.attributes;
  for (let v = 0; v < position!.count; v++) {
    const y = position!.getY(v);
    position!.setXYZ(
      v,
      position!.getX(v) * BONE_RADIUS,
      y > 0.5 ? 1 : y < -0.5 ? 0 : BULGE,
      position!.getZ(v) * BONE_RADIUS,
    );
  }
  geometry.computeVertexNormals();
  return geometry;
}

/** The skeleton of a dancer: a ball in each joint, a spindle along each bone. */
export function createBones(): Overlay {
  const material = new MeshStandardMaterial({ roughness: 0.5, metalness: 0 });
  const balls = new InstancedMesh(
    new IcosahedronGeometry(JOINT_RADIUS, 1),
    material,
    MAX_FIGURES * JOINT_COUNT,
  );
  const spindles = new InstancedMesh(spindle(), material, MAX_FIGURES * (JOINT_COUNT - 1));
  const object = new Group();
  for (const mesh of [balls, spindles]) {
    mesh.instanceMatrix.setUsage(DynamicDrawUsage);
    mesh.frustumCulled = false;
    object.add(mesh);
  }
  const colours = { leader: new Color(), reactor: new Color() };
  const contrast = new Color();
  const mixed = new Color();
  const matrix = new Matrix4();
  const turn = new Quaternion();
  const up = new Vector3(0, 1, 0);
  const [from, to, along, size] = [new Vector3(), new Vector3(), new Vector3(), new Vector3()];

  return {
    object,
    update(figures) {
      let [ball, bone] = [0, 0];
      for (const { role, joints } of figures) {
        for (let joint = 0; joint < JOINT_COUNT; joint++) {
          to.fromArray(joints, joint * 3);
          balls.setMatrixAt(ball, matrix.makeTranslation(to));
          balls.setColorAt(ball++, colours[role]);
          const parent = PARENTS[joint]!;
          if (parent < 0) continue;
          from.fromArray(joints, parent * 3);
          along.subVectors(to, from);
          const length = along.length();
          turn.setFromUnitVectors(up, along.divideScalar(Math.max(length, 1e-6)));
          // A short bone is no thicker than it is long.
          const thick = Math.min(1, length / (4 * BONE_RADIUS));
          spindles.setMatrixAt(bone, matrix.compose(from, turn, size.set(thick, length, thick)));
          spindles.setColorAt(bone++, mixed.lerpColors(colours[role], contrast, 0.55));
        }
      }
      balls.count = ball;
      spindles.count = bone;
      for (const mesh of [balls, spindles]) {
        mesh.instanceMatrix.needsUpdate = true;
        if (mesh.instanceColor) mesh.instanceColor.needsUpdate = true;
      }
    },
    setLook(look) {
      colours.leader.set(look.leader);
      colours.reactor.set(look.reactor);
      contrast.set(look.contrast);
    },
    dispose() {
      for (const mesh of [balls, spindles]) {
        mesh.geometry.dispose();
        mesh.dispose();
      }
      material.dispose();
    },
  };
}
