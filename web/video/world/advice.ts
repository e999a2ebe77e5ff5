import { FPS } from '../../motion/skeleton/clip';
import { LANDMARK_COUNT } from '../pose/landmarks';
import { BODY, L } from '../pose/landmark-names';
import { MAX_BRIDGE, type Series } from './series';
import { turnedBy } from './still-camera';

/** Visibility below which a landmark is guessed. */
const HIDDEN = 0.5;
/** Share of the frames from which something is worth a sentence. */
const OFTEN = 0.15;
/** Height of the dancer below which they are small, as a share of the picture's height. */
const SMALL = 0.3;

/** Turn of the camera that is worth a sentence, radians. */
const TURNED = 0.05;

/** How sure each frame is, 0 to 1: the mean visibility of trunk and limbs, 0 where the person is not seen. */
export function confidenceOf({ visibility, seen, frames }: Series): Float32Array {
  return Float32Array.from({ length: frames }, (_, frame) => {
    if (seen[frame] === 0) return 0;
    const sum = BODY.reduce((total, landmark) => total + visibility[frame * LANDMARK_COUNT + landmark]!, 0);
    return sum / BODY.length;
  });
}

/** Sentences about what to film better; none for a good video. */
export function adviceOn(series: Series, flipped: number): string[] {
  const { frames, gaps } = series;
  const often = (is: (frame: number) => boolean): boolean => {
    let count = 0;
    for (let frame = 0; frame < frames; frame++) count += Number(is(frame));
    return count > OFTEN * frames;
  };
  const at = (frame: number, landmark: number): number => frame * LANDMARK_COUNT + landmark;
  const hidden = (frame: number, landmarks: readonly number[]): boolean =>
    landmarks.some((landmark) => series.visibility[at(frame, landmark)]! < HIDDEN);
  const advice: string[] = [];
  const long = gaps.filter(({ start, end }) => end - start > MAX_BRIDGE);
  if (long.length > 0)
    advice.push(
      `The dancer is out of sight for longer than half a second${long.length === 1 ? '' : ` ${long.length} times, first`} ` +
        `at ${(series.start + long[0]!.start).toFixed(1)} s: the motion there is a guess.`,
    );
  if (often((frame) => hidden(frame, [L.left_ankle, L.right_ankle])))
    advice.push('The feet are often hidden or cut off: film the whole body, with some floor below the feet.');
  if (often((frame) => outside(series, frame)))
    advice.push('Arms or legs often leave the picture: step back, or turn the phone.');
  if (often((frame) => bodyPixels(series, frame) < SMALL * series.height))
    advice.push(
      'The dancer is small in the picture: come nearer, so that the body fills half of its height.',
    );
  if (often((frame) => hidden(frame, [L.left_elbow, L.right_elbow, L.left_wrist, L.right_wrist])))
    advice.push('An arm is often hidden behind the body: its place there is a guess.');
  const turned = turnedBy(series);
  if (turned > TURNED)
    advice.push(
      `The camera turned by up to ${Math.round((180 / Math.PI) * turned)}°, which was taken out of the motion: on a stand it is more exact.`,
    );
  if (flipped > 0.05 * frames)
    advice.push(
      `Front and back were hard to tell apart for ${(flipped / FPS).toFixed(1)} s: wear a colour that differs from the wall.`,
    );
  return advice;
}

function outside({ image, width, height }: Series, frame: number): boolean {
  return BODY.some((landmark) => {
    const i = frame * LANDMARK_COUNT + landmark;
    const [x, y] = [image[2 * i]!, image[2 * i + 1]!];
    return x < 0 || y < 0 || x > width || y > height;
  });
}

/** Height of the body in the picture from shoulders to ankles, made that of the whole body, pixels. */
function bodyPixels({ image }: Series, frame: number): number {
  const y = (landmark: number): number => image[2 * (frame * LANDMARK_COUNT + landmark) + 1]!;
  const shoulders = Math.min(y(L.left_shoulder), y(L.right_shoulder));
  return 1.25 * (Math.max(y(L.left_ankle), y(L.right_ankle)) - shoulders);
}
