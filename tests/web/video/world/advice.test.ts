import { describe, expect, it } from 'vitest';
import { LANDMARK_COUNT } from '../../../../web/video/pose/landmarks';
import { adviceOn } from '../../../../web/video/world/advice';
import { L } from '../../../../web/video/pose/landmark-names';
import type { Series } from '../../../../web/video/world/series';

const FRAMES = 100;

/** A dancer who is seen whole, from shoulders at 200 to ankles at 600 of 1000 pixels. */
function series(): Series {
  const image = new Float64Array(FRAMES * LANDMARK_COUNT * 2).fill(400);
  for (let frame = 0; frame < FRAMES; frame++)
    for (const [landmark, y] of [
      [L.left_shoulder, 200],
      [L.right_shoulder, 200],
      [L.left_ankle, 600],
      [L.right_ankle, 600],
    ] as const)
      image[2 * (frame * LANDMARK_COUNT + landmark) + 1] = y;
  return {
    width: 1000,
    height: 1000,
    frames: FRAMES,
    start: 2,
    image,
    world: new Float64Array(FRAMES * LANDMARK_COUNT * 3),
    visibility: new Float64Array(FRAMES * LANDMARK_COUNT).fill(1),
    centre: new Float64Array(FRAMES * 2),
    turn: Float64Array.from({ length: FRAMES * 4 }, (_, i) => Number(i % 4 === 3)),
    seen: new Uint8Array(FRAMES).fill(1),
    gaps: [],
  };
}

/** A fault in the first frames of a good video, by what is said of it. */
const FAULTS: Record<string, (video: Series, frame: number) => void> = {
  'feet are often hidden': ({ visibility }, frame) =>
    void (visibility[frame * LANDMARK_COUNT + L.right_ankle] = 0.4),
  'leave the picture': ({ image }, frame) => void (image[2 * (frame * LANDMARK_COUNT + L.left_wrist)] = -1),
  'small in the picture': ({ image }, frame) => {
    // 0.29 of the picture's height, with the head.
    for (const ankle of [L.left_ankle, L.right_ankle])
      image[2 * (frame * LANDMARK_COUNT + ankle) + 1] = 200 + 290 / 1.25;
  },
  'arm is often hidden': ({ visibility }, frame) =>
    void (visibility[frame * LANDMARK_COUNT + L.left_elbow] = 0.4),
};

describe('advice on a video', () => {
  it('is none for a good one', () => {
    expect(adviceOn(series(), 0)).toEqual([]);
  });

  it('says that the camera turned, by how much, and that this was taken out', () => {
    const video = series();
    for (let frame = 50; frame < FRAMES; frame++) video.turn.set([0, 0.1, 0, 0.995], 4 * frame);
    // Half of the frames each are so far from the middle.
    expect(adviceOn(video, 0)).toEqual([expect.stringContaining('turned by up to 6°, which was taken out')]);
  });

  it.each(Object.entries(FAULTS))('says that %s in more than 15 of 100 frames', (words, fault) => {
    const faulty = (frames: number): string[] => {
      const video = series();
      for (let frame = 0; frame < frames; frame++) fault(video, frame);
      return adviceOn(video, 0);
    };
    expect(faulty(15)).toEqual([]);
    expect(faulty(16)).toEqual([expect.stringContaining(words)]);
  });

  it('says when the dancer is out of sight for longer than half a second, and how often', () => {
    const gaps = [
      { start: 0.2, end: 0.7 },
      { start: 1, end: 1.6 },
    ];
    const once = adviceOn({ ...series(), gaps }, 0);
    expect(once).toEqual([expect.stringMatching(/longer than half a second at 3\.0 s/)]);
    const twice = adviceOn({ ...series(), gaps: [...gaps, { start: 2, end: 3 }] }, 0);
    expect(twice).toEqual([expect.stringMatching(/2 times, first at 3\.0 s/)]);
  });

  it('says for how long front and back were exchanged in more than a twentieth of the frames', () => {
    expect(adviceOn(series(), 5)).toEqual([]);
    expect(adviceOn(series(), 6)).toEqual([expect.stringMatching(/^Front and back .* 0\.2 s/)]);
  });
});
