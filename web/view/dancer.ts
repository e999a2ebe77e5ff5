import { BufferAttribute, BufferGeometry, Group, MeshStandardMaterial, SkinnedMesh } from 'three';
import type { SolvedMotion } from '../motion/clip';
import { JOINT_COUNT } from '../motion/skeleton';
import { BUILDS } from './body/part';
import { roundedOffsets, type BodyLibrary } from './body/library';
import type { BodyMesh } from './body/mesh';
import { gesture } from './gesture';
import { createPose, samplePose } from './pose';
import { createRig, type Rig } from './rig';
import type { Look, Role } from './theme';

/** One mannequin on the stage. */
export interface Dancer {
  readonly object: Group;
  readonly rig: Rig;
  readonly motion: SolvedMotion | null;
  /** Gives it another dance, or none. The body is made in the background. */
  setMotion(motion: SolvedMotion | null): void;
  /** Resolves when the body for the latest motion is on. */
  dressed(): Promise<void>;
  /** Takes the pose of its motion at a moment. */
  pose(seconds: number): void;
  /** Turns head and hands towards a partner who has been posed as well. */
  attend(partner: Dancer): void;
  /** 22 x 3 world positions in metres as drawn; all zero without a motion. */
  jointPositions(): Float32Array;
  setLook(look: Look): void;
  dispose(): void;
}

function toGeometry(body: BodyMesh): BufferGeometry {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(body.positions, 3));
  geometry.setAttribute('normal', new BufferAttribute(body.normals, 3));
  geometry.setAttribute('skinIndex', new BufferAttribute(body.skinJoints, 4));
  geometry.setAttribute('skinWeight', new BufferAttribute(body.skinWeights, 4));
  const shade = new Float32Array(body.shade.length * 3);
  body.shade.forEach((value, v) => shade.fill(value, v * 3, v * 3 + 3));
  geometry.setAttribute('color', new BufferAttribute(shade, 3));
  geometry.setIndex(new BufferAttribute(body.indices, 1));
  return geometry;
}

/**
 * @param onBody called when the body has been meshed and the picture changes.
 */
export function createDancer(role: Role, library: BodyLibrary, onBody: () => void): Dancer {
  const rig = createRig();
  const material = new MeshStandardMaterial({
    roughness: 0.62,
    metalness: 0,
    vertexColors: true,
  });
  const mesh = new SkinnedMesh(new BufferGeometry(), material);
  mesh.name = role;
  mesh.castShadow = true;
  mesh.receiveShadow = true;
  // The bones carry the body across the floor, beyond the bounds of the bind pose.
  mesh.frustumCulled = false;
  mesh.bind(rig.skeleton);
  const object = new Group();
  object.add(rig.root);
  object.visible = false;

  const pose = createPose();
  const joints = new Float32Array(JOINT_COUNT * 3);
  let motion: SolvedMotion | null = null;
  let dressing = Promise.resolve();
  let worn: BodyMesh | null = null;

  function wear(body: BodyMesh, offsets: Float32Array): void {
    worn = body;
    mesh.geometry.dispose();
    mesh.geometry = toGeometry(body);
    rig.bind(offsets);
    object.add(mesh);
    onBody();
  }

  return {
    object,
    rig,
    get motion() {
      return motion;
    },
    setMotion(next) {
      motion = next;
      object.visible = next !== null;
      if (next === null) return;
      rig.fit(next.offsets);
      dressing = library.request(next.offsets, BUILDS[role]).then((body) => {
        // Only the latest dance dresses the dancer; an earlier body may arrive later.
        if (motion === next && body !== worn) wear(body, roundedOffsets(next.offsets));
      });
    },
    dressed: () => dressing,
    pose(seconds) {
      if (motion === null) return;
      samplePose(motion, seconds, pose);
      rig.apply(pose);
    },
    attend(partner) {
      gesture(rig, partner.rig);
    },
    jointPositions() {
      return motion === null ? joints.fill(0).slice() : rig.jointPositions(joints).slice();
    },
    setLook(look) {
      material.color.set(look[role]);
    },
    dispose() {
      motion = null;
      mesh.geometry.dispose();
      material.dispose();
      rig.skeleton.dispose();
    },
  };
}
