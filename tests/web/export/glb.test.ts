import { type AnimationClip, AnimationMixer, type Object3D, SkinnedMesh, Vector3 } from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { validateBytes } from 'gltf-validator';
import { beforeAll, expect, test } from 'vitest';
import { writeGlb } from '../../../web/export/glb';
import { estimateBytes } from '../../../web/export/sizes';
import { BVH_NAMES } from '../../../web/motion/bvh/names';
import { JOINT_COUNT, SMPL22 } from '../../../web/motion/skeleton/skeleton';
import { makeBody } from '../../../web/view/body/simplify';
import { LOOKS } from '../../../web/view/theme';
import { madeDance } from '../support/made-dance';

/** Meshes bodies on this thread. */
const bodies = { request: makeBody };

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

test('played back, the bones are where the motion has the joints, in the colours of the roles', async () => {
  const glb = await writeGlb(dance, 'light', bodies);
  const { scene, animations } = await new GLTFLoader().parseAsync(glb, '');
  const [clip] = animations as [AnimationClip];
  expect(animations).toHaveLength(1);
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
