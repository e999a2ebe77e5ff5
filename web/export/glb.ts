import type { Theme } from '../common/picture';
import {
  AnimationClip,
  type BufferGeometry,
  Group,
  type KeyframeTrack,
  Matrix4,
  MeshStandardMaterial,
  QuaternionKeyframeTrack,
  Scene,
  SkinnedMesh,
  Vector3,
  VectorKeyframeTrack,
} from 'three';
import { GLTFExporter } from 'three/addons/exporters/GLTFExporter.js';
import { ARMATURES, BVH_NAMES } from '../motion/bvh/names';
import type { SolvedMotion } from '../motion/skeleton/clip';
import { restRoot } from '../motion/skeleton/kinematics';
import { JOINT_COUNT, SMPL22 } from '../motion/skeleton/skeleton';
import { toFullGeometry } from '../view/body/geometry';
import type { BodyLibrary } from '../view/body/library';
import { BUILDS } from '../view/body/part';
import { createRig, type Rig } from '../view/dancer/rig';
import { LOOKS } from '../view/theme';
import type { Dance } from './dance';

/**
 * The dance as binary glTF: for each dancer a skinned mannequin in the theme's colour of its role, bones named as in
 * our BVH, and one animation of both with a key on every frame where something moves. Metres, y up, seconds. What the
 * stage adds to the motion (turns of head and hands to the partner) is left out.
 *
 * @param bodies makes the mannequins; the caller disposes of it.
 */
export async function writeGlb(
  dance: Dance,
  theme: Theme,
  bodies: Pick<BodyLibrary, 'request'>,
): Promise<ArrayBuffer> {
  const scene = new Scene();
  scene.name = 'ReactDance';
  scene.userData = { ...dance.about };
  const tracks: KeyframeTrack[] = [];
  for (const { role, motion } of dance.dancers) {
    const body = await bodies.request(motion.offsets, BUILDS[role]);
    const rig = createRig();
    const geometry = geometryAtRest(toFullGeometry(body).clone(), rig, motion, body.offsets);
    const material = new MeshStandardMaterial({
      name: ARMATURES[role],
      color: LOOKS[theme][role],
      roughness: 0.62,
      metalness: 0,
      vertexColors: true,
    });
    const mesh = new SkinnedMesh(geometry, material);
    mesh.name = `${ARMATURES[role]} body`;
    mesh.bind(rig.skeleton, new Matrix4());
    const armature = new Group();
    armature.name = ARMATURES[role];
    armature.add(rig.root);
    // Viewers ignore the parent of a skinned mesh, so it is a sibling of its bones.
    scene.add(armature, mesh);
    tracks.push(...keys(motion, rig));
  }
  const clip = new AnimationClip('Dance', -1, tracks).optimize();
  const exporter = new GLTFExporter();
  const glb = await exporter.parseAsync(scene, { binary: true, animations: [clip] });
  if (!(glb instanceof ArrayBuffer))
    throw new TypeError('The glTF exporter returned text instead of binary glTF.');
  return glb;
}

/**
 * Puts the bones into the rest pose of our BVH, a T-pose on the floor where the dance begins, and binds them there:
 * Blender takes the pose in which a skin is bound for the bones' rest.
 *
 * @param geometry the skin as it was made; its vertices are moved to the rest pose
 * @param bound offsets that the skin was made for
 */
function geometryAtRest(
  geometry: BufferGeometry,
  rig: Rig,
  motion: SolvedMotion,
  bound: Float32Array,
): BufferGeometry {
  rig.fit(motion.offsets);
  rig.bind(bound);
  rig.root.position.set(...restRoot(motion));
  rig.root.updateMatrixWorld(true);
  rig.bones.forEach((bone, joint) => (bone.name = BVH_NAMES[SMPL22[joint] ?? 'pelvis']));

  const turns = rig.bones.map((bone, joint) =>
    new Matrix4().multiplyMatrices(bone.matrixWorld, rig.skeleton.boneInverses[joint]!),
  );
  const [position, normal] = [geometry.getAttribute('position'), geometry.getAttribute('normal')];
  const [joints, weights] = [geometry.getAttribute('skinIndex'), geometry.getAttribute('skinWeight')];
  const [point, direction, turned] = [new Vector3(), new Vector3(), new Vector3()];
  for (let vertex = 0; vertex < position.count; vertex++) {
    point.set(0, 0, 0);
    direction.set(0, 0, 0);
    for (let i = 0; i < 4; i++) {
      const weight = weights.getComponent(vertex, i);
      if (weight === 0) continue;
      const turn = turns[joints.getComponent(vertex, i)]!;
      point.addScaledVector(turned.fromBufferAttribute(position, vertex).applyMatrix4(turn), weight);
      direction.addScaledVector(turned.fromBufferAttribute(normal, vertex).transformDirection(turn), weight);
    }
    position.setXYZ(vertex, point.x, point.y, point.z);
    direction.normalize();
    normal.setXYZ(vertex, direction.x, direction.y, direction.z);
  }
  rig.skeleton.calculateInverses();
  return geometry;
}

/** Keyframe tracks of a motion. They refer to bones by UUID: the bones of two dancers have the same names. */
function keys(motion: SolvedMotion, rig: Rig): KeyframeTrack[] {
  const { frames, fps } = motion;
  const times = Array.from({ length: frames }, (_, frame) => frame / fps);
  const rotations = rig.bones.map((bone, joint) => {
    const values = new Float32Array(frames * 4);
    for (let frame = 0; frame < frames; frame++) {
      const from = (frame * JOINT_COUNT + joint) * 4;
      values.set(motion.rotations.subarray(from, from + 4), frame * 4);
    }
    return new QuaternionKeyframeTrack(`${bone.uuid}.quaternion`, times, values);
  });
  return [new VectorKeyframeTrack(`${rig.root.uuid}.position`, times, motion.root), ...rotations];
}
