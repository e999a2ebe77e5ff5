import { expect, it } from 'vitest';
import { halves } from '../../../../web/ui/video/beside';

it('halves of a wide picture lie beside each other, those of a tall one above each other', () => {
  expect(halves({ width: 1920, height: 1080 })).toEqual({
    size: { width: 960, height: 1080 },
    second: { x: 960, y: 0 },
  });
  expect(halves({ width: 1080, height: 1920 })).toEqual({
    size: { width: 1080, height: 960 },
    second: { x: 0, y: 960 },
  });
});

it('halves have an even number of pixels and lie in the picture', () => {
  const { size, second } = halves({ width: 1438, height: 900 });
  expect(size.width % 2).toBe(0);
  expect(second.x + size.width).toBe(1438);
});
