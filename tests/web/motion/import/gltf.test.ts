/** Details of glTF files: scales of all kinds, numbers of all types, and what is refused. */
import { AnimationMixer, Vector3 } from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { describe, expect, test } from 'vitest';
import { readAccessor } from '../../../../web/motion/import/gltf/accessor';
import { readContainer } from '../../../../web/motion/import/gltf/container';
import { readGltf } from '../../../../web/motion/import/gltf/read';
import { distance } from '../../../../web/motion/math/vec3';
import { worldPose } from '../../../../web/motion/retarget/sample';
import { changedGlb, writeGlb } from '../../support/motion-files/glb';
import { madeMotion } from '../../support/motion-files/made-motion';

const WORST = 0.05;
const dance = madeMotion();

/** Largest distance in millimetres of a joint from where three has it, in all frames that the file is read with. */
async function worstFromThree(bytes: Uint8Array<ArrayBuffer>): Promise<number> {
  const { scene, animations } = await new GLTFLoader().parseAsync(bytes.buffer, '');
  const mixer = new AnimationMixer(scene);
  mixer.clipAction(animations[0]!).play();
  const source = readGltf([{ name: 'a.glb', bytes }], 0);
  let worst = 0;
  for (let frame = 0; frame < source.frames; frame++) {
    mixer.setTime(Math.min(frame / source.frameRate(), animations[0]!.duration - 1e-6));
    scene.updateMatrixWorld(true);
    const { places } = worldPose(source.joints, source.localPoses([frame]), 0);
    source.joints.forEach(({ name }, joint) => {
      const { x, y, z } = scene
        .getObjectByName(name.replaceAll(/[:.]/g, ''))!
        .getWorldPosition(new Vector3());
      worst = Math.max(worst, 1000 * distance([x, y, z], places[joint]!));
    });
  }
  return worst;
}

describe('scales', () => {
  const below = (root: object): Uint8Array<ArrayBuffer> =>
    changedGlb(writeGlb(dance), ({ nodes, scenes }) => {
      scenes[0]!.nodes = [nodes.push({ name: '__root__', ...root, children: [0] }) - 1];
    });

  test.each([
    ['that mirrors', { scale: [1, 1, -1] }],
    ['that turns and mirrors, as Babylon writes it', { rotation: [0, 1, 0, 0], scale: [1, 1, -1] }],
    ['of another height', { scale: [1, 1.2, 1] }],
  ])('a root %s has the joints where three has them', async (_, root) => {
    expect(await worstFromThree(below(root))).toBeLessThan(WORST);
  });

  test('a joint of another height within the body has those below it where three has them', async () => {
    const bytes = changedGlb(writeGlb(dance), ({ nodes }) => (nodes[1]!.scale = [1, 1.2, 1]));
    expect(await worstFromThree(bytes)).toBeLessThan(WORST);
  });
});

test.each(['CUBICSPLINE', 'LINEAR'] as const)(
  'between %s keys joints are where three has them',
  async (interpolation) => {
    const slow = madeMotion({ frames: 12, fps: 4, swing: 40 });
    expect(await worstFromThree(writeGlb(slow, { interpolation }))).toBeLessThan(WORST);
  },
);

describe('accessors', () => {
  /** The values of an accessor of scalars in a file whose only buffer holds these bytes. */
  const values = (bytes: Uint8Array, accessor: object): number[] => {
    const uri = `data:application/octet-stream;base64,${Buffer.from(bytes).toString('base64')}`;
    const json = {
      asset: { version: '2.0' },
      buffers: [{ byteLength: bytes.length, uri }],
      bufferViews: [{ buffer: 0, byteOffset: 2, byteLength: bytes.length - 2 }],
      accessors: [{ bufferView: 0, type: 'SCALAR', ...accessor }],
      nodes: [],
      animations: [],
    };
    const gltf = new TextEncoder().encode(JSON.stringify(json));
    return [...readAccessor(readContainer({ name: 'a.gltf', bytes: gltf }, []), 0)];
  };

  test.each([
    ['unsigned bytes', 5121, Uint8Array.of(9, 9, 0, 51, 255), [0, 0.2, 1]],
    ['bytes, the least of which stands for -1 too', 5120, Uint8Array.of(9, 9, 129, 128, 127), [-1, -1, 1]],
    ['unsigned shorts', 5123, Uint8Array.of(9, 9, 0, 0, 51, 51, 255, 255), [0, 0.2, 1]],
    [
      'shorts, the least of which stands for -1 too',
      5122,
      Uint8Array.of(9, 9, 1, 128, 0, 128, 255, 127),
      [-1, -1, 1],
    ],
  ])('normalised %s', (_, componentType, bytes, expected) => {
    const read = values(bytes, { componentType, normalized: true, count: 3 });
    read.forEach((value, i) => expect(value).toBeCloseTo(expected[i]!, 6));
    expect(Math.min(...read)).toBeGreaterThanOrEqual(-1);
  });

  test('whole numbers that are not normalised, behind an offset of their own', () => {
    expect(values(Uint8Array.of(9, 9, 8, 7, 5, 6), { componentType: 5121, byteOffset: 2, count: 2 })).toEqual(
      [5, 6],
    );
  });

  test('without bytes of their own all are zero', () => {
    const none = { bufferView: undefined, type: 'VEC3', componentType: 5126, count: 2 };
    expect(values(Uint8Array.of(9, 9, 1, 2), none)).toEqual([0, 0, 0, 0, 0, 0]);
  });

  test('so many without bytes that they would fill the memory are refused', () => {
    const none = { bufferView: undefined, type: 'VEC4', componentType: 5126, count: 1e8 };
    expect(() => values(Uint8Array.of(9, 9, 1, 2), none)).toThrow('more than 10 million zeros');
  });

  describe('sparse', () => {
    const bytes = Uint8Array.of(9, 9, 1, 2, 3, 1, 2, 70, 80);
    const sparse = (count: number, inside: object = {}): object => ({
      count,
      indices: { bufferView: 0, byteOffset: 3, componentType: 5121 },
      values: { bufferView: 0, byteOffset: 5 },
      ...inside,
    });

    test('on values, and on zeros', () => {
      const bytewise = { componentType: 5121, count: 3, sparse: sparse(2) };
      expect(values(bytes, bytewise)).toEqual([1, 70, 80]);
      expect(values(bytes, { ...bytewise, bufferView: undefined })).toEqual([0, 70, 80]);
      const normalised = values(bytes, { ...bytewise, normalized: true });
      normalised.forEach((value, i) => expect(value).toBeCloseTo([1, 70, 80][i]! / 255, 6));
    });

    test('with places that are not there are refused', () => {
      expect(() => values(bytes, { componentType: 5121, count: 2, sparse: sparse(2) })).toThrow(
        'the values number 0 have places beyond their end',
      );
      const beyond = sparse(2, { values: { bufferView: 1 } });
      expect(() => values(bytes, { componentType: 5121, count: 3, sparse: beyond })).toThrow(
        'the values number 0 are missing',
      );
    });
  });
});

describe('buffers within the file', () => {
  const buffer = (uri: string): number[] => {
    const json = { asset: { version: '2.0' }, buffers: [{ byteLength: 4, uri }] };
    const bytes = new TextEncoder().encode(JSON.stringify(json));
    return [...readContainer({ name: 'a.gltf', bytes }, []).buffers[0]!];
  };

  test.each([
    ['base64', 'data:application/octet-stream;base64,ACz/QQ=='],
    ['base64 in capitals', 'data:;BASE64,ACz/QQ=='],
    ['percent-encoding', 'data:application/octet-stream,%00%2C%ffA'],
    ['percent-encoding, a comma as it is', 'data:,%00,%FFA'],
  ])('in %s', (_, uri) => {
    expect(buffer(uri)).toEqual([0, 0x2c, 255, 0x41]);
  });

  test('one of two files with buffers is not taken for the other', () => {
    const buffers = ['a.bin', 'b.bin'].map((uri) => ({ byteLength: 4, uri }));
    const bytes = new TextEncoder().encode(JSON.stringify({ asset: { version: '2.0' }, buffers }));
    const companion = { name: 'a.bin', bytes: new Uint8Array(4) };
    expect(() => readContainer({ name: 'a.gltf', bytes }, [companion])).toThrow('in another file, b.bin');
    const renamed = { name: 'other.bin', bytes: new Uint8Array(4) };
    const [first] = buffers;
    const one = new TextEncoder().encode(JSON.stringify({ asset: { version: '2.0' }, buffers: [first] }));
    expect(readContainer({ name: 'a.gltf', bytes: one }, [renamed]).buffers).toEqual([renamed.bytes]);
  });

  test('in broken base64 are refused', () => {
    expect(() => buffer('data:;base64,A')).toThrow('a buffer within it is not in base64');
  });
});
