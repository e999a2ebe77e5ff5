import { Euler, type Group, MathUtils, Matrix4, Vector3 } from 'three';
import { FBXLoader } from 'three/addons/loaders/FBXLoader.js';
import { describe, expect, test } from 'vitest';
import { type FbxObject, writeFbxObjects } from '../../../support/motion-files/fbx-objects';
import { readFbx } from '../../../../../web/motion/import/fbx/read';
import type { Vec3 } from '../../../../../web/motion/math/vec3';
import { worldPose } from '../../../../../web/motion/retarget/sample';

/** Places of all joints in the rest pose, by name. */
function placesIn(bytes: Uint8Array): Map<string, Vec3> {
  const { joints, rest } = readFbx(bytes, 0);
  const { places } = worldPose(joints, rest, 0);
  return new Map(joints.map(({ name }, joint) => [name, places[joint]!]));
}

/** The same as three's loader has them. */
function placesInThree(bytes: Uint8Array<ArrayBuffer>): Map<string, Vec3> {
  const group: Group = new FBXLoader().parse(bytes.buffer, '');
  group.updateMatrixWorld(true);
  const places = new Map<string, Vec3>();
  group.traverse((one) => places.set(one.name, one.getWorldPosition(new Vector3()).toArray()));
  return places;
}

/** Joints that turn, below an object of some scale. */
const chain = (scale: Vec3, inheritType: number | undefined, jointScale: Vec3 = [1, 1, 1]): FbxObject[] => {
  const how = inheritType === undefined ? {} : { inheritType };
  return [
    { name: 'Group', type: 'Null', scale, rotation: [10, -20, 15], ...how },
    {
      name: 'Hips',
      parent: 'Group',
      translation: [1, 2, 3],
      rotation: [0, 40, 30],
      scale: jointScale,
      ...how,
    },
    { name: 'Spine', parent: 'Hips', translation: [0, 5, 1], rotation: [20, 0, -50], ...how },
    { name: 'Head', parent: 'Spine', translation: [2, 5, 0], ...how },
  ];
};

/**
 * The same as the FBX SDK composes them (its sample Transformations): R is the rotations above, S what scales the parent,
 * r and s are the joint's own.
 */
function placesByHand(objects: readonly FbxObject[]): Map<string, Vec3> {
  const worlds = new Map<string, { turn: Matrix4; above: Matrix4; own: Matrix4; place: Vector3 }>();
  for (const { name, parent, translation = [0, 0, 0], rotation, scale, inheritType = 0 } of objects) {
    const [x = 0, y = 0, z = 0] = rotation?.map(MathUtils.degToRad) ?? [];
    const turn = new Matrix4().makeRotationFromEuler(new Euler(x, y, z, 'ZYX'));
    const own = new Matrix4().makeScale(...(scale ?? [1, 1, 1]));
    const up = worlds.get(parent ?? '');
    if (!up) {
      worlds.set(name, { turn, above: new Matrix4(), own, place: new Vector3(...translation) });
      continue;
    }
    const scaled = up.above.clone().multiply(up.own);
    worlds.set(name, {
      turn: up.turn.clone().multiply(turn),
      above: inheritType === 0 ? scaled : up.above,
      own,
      place: new Vector3(...translation).applyMatrix4(scaled).applyMatrix4(up.turn).add(up.place),
    });
  }
  return new Map([...worlds].map(([name, { place }]) => [name, place.toArray()]));
}

function expectSame(ours: ReadonlyMap<string, Vec3>, theirs: ReadonlyMap<string, Vec3>): void {
  for (const [name, place] of ours)
    place.forEach((value, axis) => expect(value, name).toBeCloseTo(theirs.get(name)![axis]!, 4));
}

describe('scales', () => {
  // Where a scale acts after rotations, three's objects would have to be sheared, so it loses a part.
  test.each<[string, FbxObject[]]>([
    ['a mirror, with the scale of what is above before its own rotation', chain([-1, 1, 1], 1)],
    ['a mirror, with the scale after it', chain([-1, 1, 1], 0)],
    ['a mirror, nothing said', chain([-1, 1, 1], undefined)],
    ['a stretch, with the scale before', chain([1, 3, 0.5], 1)],
    ['stretched joints, before', chain([2, 2, 2], 1, [1, 2, 0.5])],
  ])('are those of three’s loader: %s', (_, objects) => {
    const bytes = writeFbxObjects(objects);
    expectSame(placesIn(bytes), placesInThree(bytes));
  });

  test.each<[string, FbxObject[]]>([
    ['a stretch, with the scale after', chain([1, 3, 0.5], 0)],
    ['a stretch, nothing said', chain([1, 3, 0.5], undefined)],
    ['stretched joints, after', chain([2, 2, 2], 0, [1, 2, 0.5])],
    ['stretched joints whose scale is not handed on', chain([2, 2, 2], 2, [1, 2, 0.5])],
  ])('are those of the FBX SDK: %s', (_, objects) => {
    expectSame(placesIn(writeFbxObjects(objects)), placesByHand(objects));
  });

  test('a mirrored object mirrors all that hangs on it', () => {
    const plain = placesIn(writeFbxObjects(chain([1, 1, 1], 1).with(0, { name: 'Group', type: 'Null' })));
    const mirrored = placesIn(
      writeFbxObjects(chain([1, 1, 1], 1).with(0, { name: 'Group', type: 'Null', scale: [-1, 1, 1] })),
    );
    for (const [name, [x, y, z]] of plain)
      mirrored.get(name)!.forEach((value, axis) => expect(value).toBeCloseTo([-x, y, z][axis]!, 4));
  });

  test('a joint that compensates the scale of its parent hands on that of what is above', () => {
    // As in Maya: the arm keeps the armature's scale of two, and the shoulder's own of three moves the elbow alone.
    const places = placesIn(
      writeFbxObjects([
        { name: 'Armature', type: 'Null', scale: [2, 2, 2] },
        { name: 'Shoulder', parent: 'Armature', translation: [1, 0, 0], scale: [3, 3, 3], inheritType: 1 },
        { name: 'Elbow', parent: 'Shoulder', translation: [1, 0, 0], inheritType: 2 },
        { name: 'Wrist', parent: 'Elbow', translation: [1, 0, 0], inheritType: 2 },
      ]),
    );
    expect(places.get('Shoulder')![0]).toBeCloseTo(2, 4);
    expect(places.get('Elbow')![0]).toBeCloseTo(8, 4);
    expect(places.get('Wrist')![0]).toBeCloseTo(10, 4);
  });

  test('a scale of zero hides what hangs on an object, and the file is read', () => {
    for (const inheritType of [0, 1, 2])
      for (const place of placesIn(writeFbxObjects(chain([0, 0, 0], inheritType))).values())
        expect(place.every(Number.isFinite)).toBe(true);
  });
});

test('joints that come before those they hang on are read all the same', () => {
  const objects: FbxObject[] = [
    { name: 'Head', parent: 'Spine', translation: [0, 2, 0] },
    { name: 'Spine', parent: 'Hips', translation: [0, 5, 1] },
    { name: 'Hips', translation: [1, 2, 3] },
  ];
  expect([...placesIn(writeFbxObjects(objects))]).toEqual([
    ['Hips', [1, 2, 3]],
    ['Spine', [1, 7, 4]],
    ['Head', [1, 9, 4]],
  ]);
});

test('what an object looks at is not its child', () => {
  const objects: FbxObject[] = [
    { name: 'Camera', type: 'Camera', translation: [100, 0, 0] },
    { name: 'Hips', translation: [1, 2, 3] },
    { name: 'Spine', parent: 'Hips', translation: [0, 5, 1] },
  ];
  const places = placesIn(writeFbxObjects(objects, { links: [['Hips', 'Camera', 'LookAtProperty']] }));
  expect([...places]).toEqual([
    ['Hips', [1, 2, 3]],
    ['Spine', [1, 7, 4]],
  ]);
});

describe('layers of a clip', () => {
  const objects: FbxObject[] = [{ name: 'Hips' }, { name: 'Spine', parent: 'Hips' }];
  const read = (layers: readonly (readonly [string, string | null])[]): [number, readonly string[]] => {
    const source = readFbx(writeFbxObjects(objects, { layers }), 0);
    return [source.localPoses([2]).translations[1]!, source.warnings];
  };

  test('are in the unit of the file', () => {
    const { unit } = readFbx(writeFbxObjects(objects, { layers: [['Base', 'Hips']] }), 0);
    expect(unit).toEqual({ name: 'centimetres', metres: 0.01 });
  });

  test('one alone has no warning, and an empty one neither', () => {
    expect(read([['Base', 'Hips']])).toEqual([3, []]);
    expect(
      read([
        ['Base', 'Hips'],
        ['Empty', null],
      ]),
    ).toEqual([3, []]);
  });

  test('the first one with keys is read, and the others are named', () => {
    const [height, warnings] = read([
      ['Empty', null],
      ['Base', 'Hips'],
      ['Hands', 'Spine'],
      ['Corrections', 'Hips'],
    ]);
    expect(height).toBe(3);
    expect(warnings).toEqual([
      'Only the layer “Base” of this animation was read. 2 others have keys too, which were left out: merge the layers before the export.',
    ]);
  });
});
