import { expect, it } from 'vitest';
import { rowsSeen, seriesOf } from '../../../../web/video/world/series';
import { projected } from '../../support/filmed/projected';
import { walker } from '../../support/filmed/walker';

const CAMERA = { width: 640, height: 480, focal: 560, position: [0, 1.3, 4], pitch: 0.1 } as const;

/** Four seconds at 30 pictures a second in which the dancer is seen in these rows only. */
function seenIn(...rows: readonly (readonly [number, number])[]) {
  const seen = projected(walker({ seconds: 4, turn: 0.4, distance: 0.8 }), CAMERA, 0);
  const presence = seen.presence.map((value, row) =>
    rows.some(([first, last]) => row >= first && row <= last) ? value : 0,
  );
  return { ...seen, presence };
}

it('leaves out what was taken for a person for a moment, long before or after the dancer is seen', () => {
  const strays = seenIn([3, 4], [30, 33], [60, 110]);
  expect(rowsSeen(strays)).toEqual(Array.from({ length: 51 }, (_, i) => 60 + i));
  const series = seriesOf(strays)!;
  expect([series.start, series.frames]).toEqual([2, 51]);
  expect(series.gaps).toEqual([]);
});

it('keeps short sightings beside others, and those of a person who is never seen for longer', () => {
  expect(rowsSeen(seenIn([10, 12], [20, 60]))).toHaveLength(3 + 41);
  expect(rowsSeen(seenIn([10, 14], [60, 62]))).toHaveLength(5 + 3);
});
