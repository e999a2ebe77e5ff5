import { describe, expect, test, vi } from 'vitest';
import { leaderBvh } from '../../../support/leader-bvh';
import { AppError, type ErrorCode } from '../../../../../web/common/error';
import { type BodyNames, madeBody, madeBvh, MIXAMO } from '../../../support/made-bvh';

const good = madeBvh({ joints: madeBody(MIXAMO), frames: 12 }).text;
const lines = good.split('\n');
const lineOf = (pattern: RegExp): number => lines.findIndex((line) => pattern.test(line)) + 1;
/** Line of the first frame, counted from 1. */
const firstFrame = lineOf(/^Frame Time/) + 1;
const columns = 6 + 3 * (madeBody(MIXAMO).length - 1);

function withLine(number: number, change: (line: string) => string): string {
  return lines.map((line, i) => (i === number - 1 ? change(line) : line)).join('\n');
}

function failure(text: string, fps?: number): AppError {
  const noise = vi.spyOn(console, 'error').mockImplementation(() => undefined);
  try {
    leaderBvh(text, fps === undefined ? {} : { fps });
  } catch (error) {
    expect(error).toBeInstanceOf(AppError);
    expect(noise).not.toHaveBeenCalled();
    return error as AppError;
  } finally {
    noise.mockRestore();
  }
  throw new Error('the file was read');
}

function expectFailure(text: string, code: ErrorCode, message: RegExp | string): void {
  const error = failure(text);
  expect(error.code).toBe(code);
  expect(error.message).toMatch(message);
  for (const sentence of [error.message, error.hint]) expect(sentence).toMatch(/^[A-Z].{15,}\.$|\)\.?$/);
}

test('the file that is damaged below is read while it is intact', () => {
  expect(leaderBvh(good).clip.frames).toBe(12);
});

describe('what is no BVH file', () => {
  test.each(['', '\n \n', '\uFEFF\n'])('empty: %j', (text) => expectFailure(text, 'empty-file', 'is empty'));
  test.each(['hello', '<!doctype html>', 'Kaydara FBX Binary', '{"asset": {}}', '\u0000\u0001\u0002'])(
    'something else: %j',
    (text) => expectFailure(text, 'not-bvh', 'does not begin with HIERARCHY'),
  );
});

test('blank lines without end: those after the motion are left out, others are refused', () => {
  expect(leaderBvh(good + '\n'.repeat(2e7)).clip.frames).toBe(12);
  expectFailure(`HIERARCHY${'\n'.repeat(6e6)}}`, 'too-long', 'more than 5 million lines');
});

describe('cut off', () => {
  test('at any character, it gives an error or the complete frames', () => {
    const starts = lines.map((_, i) => lines.slice(0, i).join('\n').length + 1);
    for (let end = 0; end < good.length; end += 97) {
      const whole = starts.filter((start, i) => i >= firstFrame && start <= end).length;
      const text = good.slice(0, end);
      if (whole < 2) {
        const { code } = failure(text);
        expect(['empty-file', 'not-bvh', 'truncated', 'bad-hierarchy', 'bad-number']).toContain(code);
      } else {
        const { clip, report } = leaderBvh(text);
        expect(clip.frames).toBe(whole);
        expect(report.warnings.join()).toMatch(
          new RegExp(`^The file ends .* of 12; the ${whole} whole frames are used\\.$`),
        );
      }
    }
  });
  test('in the skeleton', () => {
    const cut = lineOf(/JOINT mixamorig:LeftArm/);
    expectFailure(lines.slice(0, cut).join('\n'), 'truncated', `ends at line ${cut}, in the middle`);
  });
  test('after the skeleton', () => {
    expectFailure(lines.slice(0, lineOf(/^MOTION/) - 1).join('\n'), 'truncated', 'its motion is missing');
  });
  const upTo = (frames: number): string => lines.slice(0, firstFrame - 1 + frames).join('\n') + '\n';
  test.each([
    ['a value', '-', 'in the middle of frame 8'],
    ['an exponent', '1.0 2.0 1e', 'in the middle of frame 8'],
    ['a frame', '1.0 '.repeat(30), 'in the middle of frame 8'],
    ['the last value', lines[firstFrame + 6]!, 'in the middle of frame 8'],
    ['a frame, and filled up', '1.0 2.0 \0\0\0\0', 'in the middle of frame 8'],
    ['nothing', '', 'after frame 7'],
    ['nothing, with empty lines', '\r\n \n', 'after frame 7'],
  ])('in the motion, within %s', (_, rest, where) => {
    const { clip, report } = leaderBvh(upTo(7) + rest);
    expect(report.warnings).toEqual([`The file ends ${where} of 12; the 7 whole frames are used.`]);
    expect(clip.frames).toBe(7);
    const whole = leaderBvh(upTo(7).replace('Frames: 12', 'Frames: 7'));
    expect(whole.report.warnings).toEqual([]);
    expect(clip.positions).toEqual(whole.clip.positions);
  });
  test('in the last frame', () => {
    const { report } = leaderBvh(upTo(11) + '1.0 2.0 -');
    expect(report.warnings).toEqual([
      'The file ends in the middle of frame 12 of 12; the 11 whole frames are used.',
    ]);
    const complete = good.trimEnd();
    expect(leaderBvh(complete).report.warnings).toEqual([]);
  });
  test('too early for a motion', () => {
    expectFailure(
      upTo(1) + '1.0 -',
      'truncated',
      'in the middle of frame 2 of 12: only one whole frame is there',
    );
    expectFailure(upTo(0) + '1.0 -', 'truncated', 'in the middle of frame 1 of 12: no whole frame is there');
    expectFailure(upTo(1), 'truncated', 'says that it has 12 frames, but only one whole frame is there');
    expectFailure(upTo(0), 'truncated', 'says that it has 12 frames, but no whole frame is there');
    const quick = upTo(3).replace(/Frame Time: .*/, 'Frame Time: 0.008333');
    expectFailure(quick, 'truncated', 'The file breaks off: only 3 whole frames are there');
    expect(failure(upTo(1)).hint).toMatch(/download, copy or export it again/);
  });
  test('not cut off, but wrong in the last line', () => {
    const at = firstFrame + 11;
    expectFailure(
      withLine(at, (line) => line.replace(/^\S+/, 'abc')),
      'bad-number',
      `Line ${at}, frame 12`,
    );
    expectFailure(
      upTo(0) + lines[firstFrame - 1]!.replaceAll('.', ',') + '\n',
      'bad-number',
      `Line ${firstFrame}`,
    );
  });
  test('before the number of frames', () => {
    expectFailure(lines.slice(0, lineOf(/^MOTION/)).join('\n'), 'bad-hierarchy', '"Frames:" is missing');
  });
});

describe('invalid numbers', () => {
  const at = firstFrame + 4;
  test.each([
    ['12.3.4', '"12.3.4" is not a number'],
    ['abc', '"abc" is not a number'],
    ['NaN', '"NaN" is not a number'],
    ['-1.#IND', 'is no(t| finite)'],
    ['Infinity', '"Infinity" is not a number'],
    ['1e30', '1e30 is too large'],
  ])('%s in a frame', (word, message) => {
    const text = withLine(at, (line) => line.replace(/^(\S+ \S+ \S+ \S+) \S+/, `$1 ${word}`));
    expectFailure(text, 'bad-number', new RegExp(`^Line ${at}, frame 5: .*${message}`));
    expect(failure(text).message).toContain('Xrotation of mixamorig:Hips');
  });
  test('decimal commas are recognised', () => {
    const text = withLine(at, (line) => line.replaceAll('.', ','));
    expectFailure(text, 'bad-number', `Line ${at}`);
    expect(failure(text).hint).toMatch(/comma/);
  });
  test('in an OFFSET', () => {
    const line = lineOf(/JOINT mixamorig:LeftLeg/) + 2;
    const text = withLine(line, (old) => old.replace(/OFFSET \S+/, 'OFFSET x1'));
    expectFailure(
      text,
      'bad-number',
      `Line ${line}: in the OFFSET of mixamorig:LeftLeg, "x1" is not a number`,
    );
  });
  test('in the number of frames', () => {
    expectFailure(
      good.replace('Frames: 12', 'Frames: many'),
      'bad-number',
      '"many" is not a number of frames',
    );
  });
});

describe('the wrong number of columns', () => {
  const at = firstFrame + 3;
  test('one too many', () => {
    const message = `Line ${at}, frame 4: ${columns + 1} values, but the skeleton has ${columns} channels`;
    expectFailure(
      withLine(at, (line) => line + ' 1'),
      'wrong-columns',
      message,
    );
  });
  test('one too few', () => {
    const text = withLine(at, (line) => line.trim().split(' ').slice(1).join(' '));
    expectFailure(text, 'wrong-columns', `Line ${at}, frame 4: ${columns - 1} values`);
  });
});

describe('an invalid skeleton', () => {
  test.each([
    [/\tOFFSET/, '\tOFFSETS', 'has no OFFSET'],
    [/Xrotation/, 'Xscale', '"Xscale" in mixamorig:Hips is not a channel'],
    [/Xrotation/, 'Zrotation', 'mixamorig:Hips has the channel Zrotation twice'],
    [/CHANNELS 6/, 'CHANNELS 7', 'mixamorig:Hips has 7 channels; a joint has 0 to 6'],
    [/JOINT/, 'BONE', 'expected JOINT, End Site or "}" in mixamorig:Hips, found "BONE"'],
    [/ROOT/, 'START', 'expected ROOT, found "START"'],
  ])('%s', (what, by, message) => expectFailure(good.replace(what, by), 'bad-hierarchy', message));
  test('a brace that is missing', () => {
    const last = lineOf(/^MOTION/) - 1;
    expectFailure(
      withLine(last, () => ''),
      'bad-hierarchy',
      '"}" of mixamorig:Hips is missing',
    );
  });
  test('joints that never end', () => {
    const endless = 'HIERARCHY\nROOT a\n' + '{ OFFSET 0 0 0 JOINT b\n'.repeat(500);
    expectFailure(endless, 'bad-hierarchy', 'deep');
    const wide = `HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\n${'End Site\n{\nOFFSET 0 0 1\n}\n'.repeat(1000)}}`;
    expectFailure(wide, 'bad-hierarchy', 'more than 1000 joints');
  });
  test('a body without size', () => {
    const flat = good.replaceAll(/OFFSET .*/g, 'OFFSET 0 0 0');
    expectFailure(flat, 'not-a-body', 'all lie in one place');
  });
});

describe('time', () => {
  test.each(['0', '-0.03', 'fast', '10', '0.0000001', ''])('a frame time of %j', (frameTime) => {
    const text = good.replace(/Frame Time: .*/, `Frame Time: ${frameTime}`);
    expectFailure(text, 'bad-frame-time', 'states a frame time of');
    expect(leaderBvh(text, { fps: 30 }).clip.frames).toBe(12);
  });
  test.each([0, -30, Number.NaN, 1e6])('a given rate of %d', (fps) => {
    expect(failure(good, fps).code).toBe('bad-frame-time');
  });
  test('one frame', () => {
    const { text } = madeBvh({ joints: madeBody(MIXAMO), frames: 1 });
    expectFailure(text, 'too-few-frames', 'one frame, a pose and not a motion');
  });
  test('no frames', () => {
    const { text } = madeBvh({ joints: madeBody(MIXAMO), frames: 0 });
    expectFailure(text, 'too-few-frames', 'no frames');
  });
  test('a few frames at a high rate', () => {
    const { text } = madeBvh({ joints: madeBody(MIXAMO), frames: 3, frameTime: '0.005' });
    expectFailure(text, 'bad-frame-time', 'less than two frames');
  });
});

describe('missing joints', () => {
  const body = (names: Partial<BodyNames>, drop: readonly (keyof BodyNames)[]): string => {
    const kept = Object.fromEntries(
      Object.entries({ ...MIXAMO, ...names }).filter(([part]) => !drop.includes(part as keyof BodyNames)),
    );
    return madeBvh({ joints: madeBody(kept as unknown as BodyNames), frames: 4 }).text;
  };
  test('legs', () => {
    const text = body({}, ['hip', 'knee', 'ankle', 'toe']);
    expectFailure(
      text,
      'missing-joints',
      'has no legs: no joint was found for left hip, left knee, left ankle',
    );
    expect(failure(text).hint).toMatch(
      /^Its joints are called mixamorig:Hips, mixamorig:Spine.* and 6 more\. /,
    );
  });
  test('arms', () => {
    const text = body({}, ['shoulder', 'elbow', 'wrist', 'collar']);
    expectFailure(text, 'missing-joints', 'has no arms: no joint was found for left shoulder');
  });
  test('knees', () => {
    expectFailure(
      body({}, ['knee']),
      'missing-joints',
      'is incomplete: no joint was found for left knee, right knee.',
    );
  });
  test('neck and head', () => {
    expectFailure(body({}, ['neck', 'head']), 'missing-joints', 'no joint was found for neck or head');
  });
  test('all joints, with names that no convention has and one leg', () => {
    const text = body({}, [])
      .replaceAll('0.000000 -42.000000', '0.000000 -2.000000')
      .replaceAll(/(ROOT|JOINT) \S+:(\S+)/g, (_, kind: string, name: string) => `${kind} q${name}q`);
    expectFailure(text, 'missing-joints', 'has no legs and no arms');
  });
});
