/** Units and axes of ASF skeletons, which are the same in all files of the CMU library. */
import { expect, test } from 'vitest';
import { readAsf } from '../../../../web/motion/import/amc/asf';
import { aboutAxis, multiply } from '../../../../web/motion/math/quat';
import { X_AXIS, Z_AXIS } from '../../../../web/motion/math/vec3';

const skeleton = (length: number, angle: string): string => `:units
  mass 1.0
  length ${length}
  angle ${angle}
:root
  order TX TY TZ RX RY RZ
  axis ZYX
  position 0 0 0
  orientation 90 0 90
:bonedata
  begin
    name arm
    direction 1 0 0
    length 2
    axis 90 0 90 ZYX
    dof rx ry rz
  end
:hierarchy
  begin
    root arm
  end
`;

test('a unit is an inch over the stated length, and angles are degrees unless the file says else', () => {
  expect(readAsf(skeleton(0.45, 'deg')).metres).toBeCloseTo(0.05644, 5);
  expect(readAsf(skeleton(1, 'deg'))).toMatchObject({ metres: 0.0254, radians: Math.PI / 180 });
  expect(readAsf(skeleton(1, 'rad')).radians).toBe(1);
});

test('axes of root and bones turn in the order that the file states', () => {
  const expected = multiply(aboutAxis(X_AXIS, Math.PI / 2), aboutAxis(Z_AXIS, Math.PI / 2));
  const { bones } = readAsf(skeleton(1, 'deg'));
  expect(bones.map(({ name }) => name)).toEqual(['root', 'arm']);
  for (const { axes } of bones)
    axes.forEach((value, i) => {
      expect(value).toBeCloseTo(expected[i]!, 9);
    });
});
