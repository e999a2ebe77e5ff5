import { Euler, type EulerOrder, MathUtils, Matrix4, Quaternion, Vector3 } from 'three';
import { expect, test } from 'vitest';
import { random } from '../../../support/made-dancer';
import type { FbxValue } from '../../../../../web/motion/import/fbx/node';
import { rigOf } from '../../../../../web/motion/import/fbx/transform';
import type { Vec3 } from '../../../../../web/motion/math/vec3';

/** Orders of three by FBX's number: three names the axis that turns last first. */
const ORDERS: readonly EulerOrder[] = ['ZYX', 'YZX', 'XZY', 'ZXY', 'YXZ', 'XYZ'];

const shift = (v: Vec3): Matrix4 => new Matrix4().makeTranslation(...v);
const back = (v: Vec3): Matrix4 => shift(v).invert();
const turn = (degrees: Vec3, order: EulerOrder): Matrix4 => {
  const [x, y, z] = degrees.map(MathUtils.degToRad) as [number, number, number];
  return new Matrix4().makeRotationFromEuler(new Euler(x, y, z, order));
};

test.each([0, 1, 2, 3, 4, 5])(
  'pivots, offsets and rotations as the FBX SDK composes them, order %d',
  (order) => {
    const next = random(order + 1);
    const vector = (size: number): Vec3 => [
      size * (next() - 0.5),
      size * (next() - 0.5),
      size * (next() - 0.5),
    ];
    for (let time = 0; time < 20; time++) {
      const given = {
        RotationOffset: vector(20),
        RotationPivot: vector(20),
        PreRotation: vector(300),
        PostRotation: vector(300),
        ScalingOffset: vector(20),
        ScalingPivot: vector(20),
      };
      const [translation, rotation] = [vector(100), vector(700)];
      const scale = vector(1).map((value) => 1 + value) as unknown as Vec3;
      const properties = new Map<string, readonly FbxValue[]>([
        ['RotationActive', [1]],
        ['RotationOrder', [order]],
        ...Object.entries(given),
      ]);
      const { place, turn: turned } = rigOf({ id: '1', name: 'joint', type: 'LimbNode', properties }).local(
        translation,
        rotation,
        scale,
      );
      // T Roff Rp Rpre R Rpost⁻¹ Rp⁻¹ Soff Sp S Sp⁻¹
      const whole = [
        shift(translation),
        shift(given.RotationOffset),
        shift(given.RotationPivot),
        turn(given.PreRotation, 'ZYX'),
        turn(rotation, ORDERS[order]!),
        turn(given.PostRotation, 'ZYX').invert(),
        back(given.RotationPivot),
        shift(given.ScalingOffset),
        shift(given.ScalingPivot),
        new Matrix4().makeScale(...scale),
        back(given.ScalingPivot),
      ].reduce((product, matrix) => product.multiply(matrix), new Matrix4());
      const [position, quaternion, size] = [new Vector3(), new Quaternion(), new Vector3()];
      whole.decompose(position, quaternion, size);
      position.toArray().forEach((value, axis) => expect(place[axis]).toBeCloseTo(value, 8));
      expect(Math.abs(quaternion.dot(new Quaternion(...turned)))).toBeCloseTo(1, 10);
      size.toArray().forEach((value, axis) => expect(value).toBeCloseTo(scale[axis]!, 8));
    }
  },
);

test('without RotationActive the joint has neither order nor pre- and post-rotation', () => {
  const properties = new Map<string, readonly FbxValue[]>([
    ['RotationActive', [0]],
    ['RotationOrder', [4]],
    ['PreRotation', [10, 20, 30]],
    ['PostRotation', [40, 50, 60]],
  ]);
  const { turn: turned } = rigOf({ id: '1', name: 'joint', type: 'LimbNode', properties }).local(
    [0, 0, 0],
    [70, 80, 90],
    [1, 1, 1],
  );
  const expected = new Quaternion().setFromRotationMatrix(turn([70, 80, 90], 'ZYX'));
  expect(Math.abs(expected.dot(new Quaternion(...turned)))).toBeCloseTo(1, 10);
});
