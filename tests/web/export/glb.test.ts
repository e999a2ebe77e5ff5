import { type AnimationClip, AnimationMixer, Matrix4, type Object3D, SkinnedMesh, Vector3 } from 'three';
import { BVHLoader } from 'three/addons/loaders/BVHLoader.js';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { validateBytes } from 'gltf-validator';
import { beforeAll, expect, test } from 'vitest';
import { writeGlb } from '../../../web/export/glb';
import { atFrameRate } from '../../../web/export/rate';
import { estimateBytes } from '../../../web/export/sizes';
import { BVH_NAMES, OWN_CONVENTION, REFERENCE } from '../../../web/motion/bvh/names';
import { readLeaderFile } from '../../../web/motion/import/read';
import { JOINT_COUNT, SMPL22 } from '../../../web/motion/skeleton/skeleton';
import { writeBvh } from '../../../web/motion/bvh/write';
import { toFullGeometry } from '../../../web/view/body/geometry';
import { BUILDS } from '../../../web/view/body/part';
import { makeBody } from '../../../web/view/body/simplify';
import { createRig } from '../../../web/view/dancer/rig';
import { LOOKS } from '../../../web/view/theme';
import { madeDance } from '../support/made-dance';

/** Meshes bodies on this thread, each once: as the library does. */
const made = new Map<string, ReturnType<typeof makeBody>>();
const bodies = {
  request(...[offsets, build]: Parameters<typeof makeBody>): ReturnType<typeof makeBody> {
    const key = JSON.stringify([Array.from(offsets), build]);
    const body = made.get(key) ?? makeBody(offsets, build);
    made.set(key, body);
    return body;
  },
};

beforeAll(() => {
  // three.js reads its blobs with a FileReader, which Node does not have.
  class Reader {
    result: ArrayBuffer | null = null;
    onloadend: (() => void) | null = null;
    readAsArrayBuffer(blob: Blob): void {
      void blob.arrayBuffer().then((bytes) => {
        this.result = bytes;
        this.onloadend?.();
      });
    }
  }
  Object.assign(globalThis, { FileReader: Reader, self: globalThis });
});

const dance = madeDance(60, 'leader', 'reactor');

test('the Khronos validator finds no error and no warning', async () => {
  for (const one of [dance, madeDance(1, 'reactor')]) {
    const glb = await writeGlb(one, 'dark', bodies);
    const { issues, info } = await validateBytes(new Uint8Array(glb));
    expect(issues.messages.filter(({ severity }) => severity < 2)).toEqual([]);
    expect(issues).toMatchObject({ numErrors: 0, numWarnings: 0 });
    expect(info).toMatchObject({ animationCount: 1, totalVertexCount: expect.any(Number) as number });
  }
});

test.each([60, 930])('the size of %i frames is estimated before they are written', async (frames) => {
  const long = madeDance(frames, 'leader', 'reactor');
  const { byteLength } = await writeGlb(long, 'dark', bodies);
  expect(Math.abs(estimateBytes('glb', long) / byteLength - 1)).toBeLessThan(0.05);
});

test.each([0.25, 1.45])(
  'the size goes with the height of the dancers, %f times the usual one',
  async (height) => {
    const sized = ({ motion, role }: (typeof dance.dancers)[number]) => ({
      role,
      motion: { ...motion, offsets: motion.offsets.map((value) => value * height) },
    });
    const other = { ...dance, dancers: dance.dancers.map(sized) };
    const { byteLength } = await writeGlb(other, 'dark', bodies);
    expect(Math.abs(estimateBytes('glb', other) / byteLength - 1)).toBeLessThan(0.05);
  },
);

test('the size counts the turns of head and wrists where a dancer has them, as a leader from a file', async () => {
  const long = madeDance(930, 'leader');
  const [leader] = long.dancers;
  const rotations = leader!.motion.rotations.map((value, at) =>
    at % 4 === 0 ? value + 1e-3 * Math.sin(at) : value,
  );
  const turning = { ...long, dancers: [{ ...leader!, motion: { ...leader!.motion, rotations } }] };
  const { byteLength } = await writeGlb(turning, 'dark', bodies);
  expect(Math.abs(estimateBytes('glb', turning) / byteLength - 1)).toBeLessThan(0.05);
});

test('the skin is bound in the rest pose of the BVH, with the soles on the floor', async () => {
  const { scene } = await new GLTFLoader().parseAsync(await writeGlb(dance, 'dark', bodies), '');
  for (const { role, motion } of dance.dancers) {
    const skin = scene.getObjectByName(`${role === 'leader' ? 'Leader' : 'Reactor'}_body`) as SkinnedMesh;
    const { bones, boneInverses } = skin.skeleton;
    const bound = (name: string): Vector3 => {
      const bone = bones.findIndex((each) => each.name.replace(/_\d+$/, '') === name);
      return new Vector3().setFromMatrixPosition(boneInverses[bone]!.clone().invert());
    };
    const inFile = new BVHLoader().parse(writeBvh(motion)).skeleton.bones;
    inFile[0]!.updateMatrixWorld(true);
    // In a BVH file, which has one dancer, they stand at the origin; in GLB each stands where the dance begins.
    const [x, , z] = motion.root;
    for (const bone of inFile.filter(({ name }) => name !== 'ENDSITE' && name !== REFERENCE)) {
      const there = bone
        .getWorldPosition(new Vector3())
        .divideScalar(100)
        .add(new Vector3(x, 0, z));
      expect(bound(bone.name).distanceTo(there), bone.name).toBeLessThan(1e-4);
    }
    skin.geometry.computeBoundingBox();
    expect(Math.abs(skin.geometry.boundingBox!.min.y)).toBeLessThan(0.004);
    // Arms are level, as in a T-pose.
    const hand = skin.geometry.boundingBox!.max.x - bound('Hips').x;
    expect(hand).toBeGreaterThan(bound('LeftHand').x - bound('Hips').x);
  }
});

test('played back, the skin is where the stage draws it, to a centimetre', async () => {
  const { scene, animations } = await new GLTFLoader().parseAsync(await writeGlb(dance, 'dark', bodies), '');
  const mixer = new AnimationMixer(scene);
  mixer.clipAction(animations[0]!).play();
  mixer.setTime(17 / 30);
  scene.updateMatrixWorld(true);
  for (const { role, motion } of dance.dancers) {
    const body = await bodies.request(motion.offsets, BUILDS[role]);
    const rig = createRig();
    rig.fit(motion.offsets);
    rig.bind(body.offsets);
    rig.root.position.fromArray(motion.root, 17 * 3);
    rig.bones.forEach((bone, joint) =>
      bone.quaternion.fromArray(motion.rotations, (17 * JOINT_COUNT + joint) * 4),
    );
    const drawn = new SkinnedMesh(toFullGeometry(body));
    drawn.bind(rig.skeleton, new Matrix4());
    rig.root.updateMatrixWorld(true);
    rig.skeleton.update();
    const inFile = scene.getObjectByName(role === 'leader' ? 'Leader_body' : 'Reactor_body') as SkinnedMesh;
    inFile.skeleton.update();
    const gaps: number[] = [];
    const turns: number[] = [];
    for (let vertex = 0; vertex < drawn.geometry.getAttribute('position').count; vertex++) {
      const [a, b] = [drawn, inFile].map((mesh) => mesh.getVertexPosition(vertex, new Vector3()));
      gaps.push(a!.distanceTo(b!));
      turns.push(normalAt(drawn, vertex).angleTo(normalAt(inFile, vertex)));
    }
    const most = (values: number[]): number =>
      values.sort((a, b) => a - b)[Math.floor(0.95 * values.length)]!;
    expect(most(gaps)).toBeLessThan(0.01);
    expect(most(turns)).toBeLessThan(0.04);
  }
});

test.each(['leader', 'reactor'] as const)('read as a leader, the %s is where it was', async (role) => {
  const one = madeDance(60, role);
  const bytes = new Uint8Array(await writeGlb(one, 'dark', bodies));
  const { clip, report } = await readLeaderFile([{ name: 'dance.glb', bytes }]);
  expect(report.convention).toBe(OWN_CONVENTION);
  expect(report.estimated).toEqual([]);
  one.dancers[0]!.motion.positions.forEach((value, i) => expect(clip.positions[i]).toBeCloseTo(value, 3));
});

/** Normal of a skin in its present pose. */
function normalAt(skin: SkinnedMesh, vertex: number): Vector3 {
  const { position, normal } = skin.geometry.attributes;
  const tip = new Vector3()
    .fromBufferAttribute(position!, vertex)
    .addScaledVector(new Vector3().fromBufferAttribute(normal!, vertex), 0.01);
  return skin.applyBoneTransform(vertex, tip).sub(skin.getVertexPosition(vertex, new Vector3())).normalize();
}

test.each([30, 60] as const)('keys lie on the frames: from 0, %i a second', async (rate) => {
  const glb = await writeGlb(atFrameRate(dance, rate), 'dark', bodies);
  const { animations } = await new GLTFLoader().parseAsync(glb, '');
  const frames = Math.floor((59 * rate) / 30);
  expect(animations[0]!.duration).toBeCloseTo(frames / rate, 5);
  for (const { times } of animations[0]!.tracks) {
    expect(times[0]).toBe(0);
    for (const time of times) expect(time).toBe(Math.fround(Math.round(time * rate) / rate));
  }
});

test('played back, the bones are where the motion has the joints, in the colours of the roles', async () => {
  const glb = await writeGlb(dance, 'light', bodies);
  const { scene, animations } = await new GLTFLoader().parseAsync(glb, '');
  const [clip] = animations as [AnimationClip];
  expect(animations).toHaveLength(1);
  expect(scene.userData).toMatchObject(dance.about);
  expect(clip.duration).toBeCloseTo(59 / 30, 5);
  const mixer = new AnimationMixer(scene);
  mixer.clipAction(clip).play();
  for (const { role, motion } of dance.dancers) {
    const name = role === 'leader' ? 'Leader' : 'Reactor';
    const bones: Object3D[] = [];
    scene.getObjectByName(name)!.traverse((bone) => bones.push(bone));
    // This loader makes names unique by adding a number to those of the second dancer; the file has them without.
    const bone = (joint: number): Object3D =>
      bones.find((each) => each.name.replace(/_\d+$/, '') === BVH_NAMES[SMPL22[joint]!])!;
    for (const frame of [0, 17, 59]) {
      mixer.setTime(Math.min(frame / 30, clip.duration - 1e-6));
      scene.updateMatrixWorld(true);
      for (let joint = 0; joint < JOINT_COUNT; joint++) {
        const at = new Vector3().setFromMatrixPosition(bone(joint).matrixWorld);
        const truth = new Vector3().fromArray(motion.positions, (frame * JOINT_COUNT + joint) * 3);
        expect(at.distanceTo(truth)).toBeLessThan(1e-4);
      }
    }
    const body = scene.getObjectByName(`${name}_body`);
    expect(body).toBeInstanceOf(SkinnedMesh);
    const { material } = body as SkinnedMesh & { material: { color: { getHex(): number } } };
    expect(material.color.getHex()).toBe(LOOKS.light[role]);
  }
});
