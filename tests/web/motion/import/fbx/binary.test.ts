import { expect, test } from 'vitest';
import { binaryFbx, node } from '../../../support/motion-files/fbx';
import { readBinary } from '../../../../../web/motion/import/fbx/binary';

test.each([false, true])('whole numbers of one byte, alone and in arrays, packed: %s', (packed) => {
  const bytes = binaryFbx(
    [
      node(
        'Objects',
        [],
        [
          node('Flags', [
            ['Z', -3],
            ['c', [0, 7, 255]],
            ['I', 5],
          ]),
        ],
      ),
    ],
    packed,
  );
  const [objects] = readBinary(bytes);
  expect(objects!.children[0]!.values).toEqual([-3, new Float64Array([0, 7, 255]), 5]);
});
