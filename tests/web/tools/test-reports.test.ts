import { describe, expect, it } from 'vitest';
import { noReport, readPlaywright, readPytest, readVitest, summary } from '../../../tools/test-reports.mjs';

const vitest = (success: boolean, numFailedTests: number): string =>
  JSON.stringify({
    numPassedTests: 4,
    numFailedTests,
    numPendingTests: 1,
    numTodoTests: 1,
    success,
    testResults: [
      { assertionResults: [{ fullName: 'clip is cut', status: 'passed' }] },
      {
        assertionResults: [
          { fullName: 'recorded dances: real data not present', status: 'skipped' },
          { fullName: 'clip is looped', status: 'todo' },
        ],
      },
    ],
  });

const pytest = `<?xml version="1.0" encoding="utf-8"?><testsuites name="pytest tests">
<testsuite name="pytest" errors="1" failures="2" skipped="2" tests="12" time="4.2" hostname="vm">
<testcase classname="tests.python.test_a" name="test_one" time="0.1" />
<testcase classname="tests.python.test_a" name="test_two" time="0.1">
<skipped type="pytest.skip" message="real data not present">a.py:35: real data not present</skipped></testcase>
<testcase classname="tests.python.test_a" name="test_three" time="0.1">
<skipped type="pytest.skip" message="&quot;ffmpeg&quot; &amp; others are missing">a.py:9</skipped></testcase>
</testsuite></testsuites>`;

const spec = (title: string, status: string, reason?: string): object => ({
  title,
  tests: [{ status, annotations: reason === undefined ? [] : [{ type: 'skip', description: reason }] }],
});

const playwright = JSON.stringify({
  stats: { expected: 2, flaky: 2, unexpected: 1, skipped: 2 },
  errors: [{ message: 'a file that does not compile' }],
  suites: [
    {
      title: 'takes.spec.ts',
      specs: [spec('a take is renamed', 'flaky'), spec('a take is kept', 'expected')],
      suites: [
        {
          title: 'with two takes',
          specs: [spec('one is chosen', 'flaky'), spec('one is removed', 'unexpected')],
        },
      ],
    },
    {
      title: 'audio.spec.ts',
      specs: [
        spec('real songs', 'skipped', 'real data not present'),
        spec('a long song', 'skipped'),
        spec('a short song', 'expected'),
      ],
    },
  ],
});

describe('reports of test runners', () => {
  it('counts what vitest ran, and a file that it could not load as a failure', () => {
    const reasons = ['recorded dances: real data not present', 'clip is looped'];
    expect(readVitest(vitest(true, 0))).toEqual({ passed: 4, failed: 0, skipped: 2, retried: [], reasons });
    expect(readVitest(vitest(false, 0)).failed).toBe(1);
    expect(readVitest(vitest(false, 3)).failed).toBe(3);
  });

  it('counts what pytest ran, errors as failures, with the reasons of skipped tests', () => {
    expect(readPytest(pytest)).toEqual({
      passed: 7,
      failed: 3,
      skipped: 2,
      retried: [],
      reasons: ['real data not present', '"ffmpeg" & others are missing'],
    });
  });

  it('counts what Playwright ran, with the full names of tests that passed on a second try', () => {
    expect(readPlaywright(playwright)).toEqual({
      passed: 4,
      failed: 2,
      skipped: 2,
      retried: ['takes.spec.ts › a take is renamed', 'takes.spec.ts › with two takes › one is chosen'],
      reasons: ['real data not present', 'audio.spec.ts › a long song'],
    });
  });
});

describe('summary', () => {
  it('names second tries just before the counts, which are the last line', () => {
    expect(summary([readPytest(pytest), readPlaywright(playwright)], false).split('\n')).toEqual([
      'skipped: 2 x real data not present',
      'skipped: 1 x "ffmpeg" & others are missing',
      'skipped: 1 x audio.spec.ts › a long song',
      'needed a second try: takes.spec.ts › a take is renamed',
      'needed a second try: takes.spec.ts › with two takes › one is chosen',
      '11 passed, 5 failed, 4 skipped',
    ]);
  });

  it('is the counts alone when there is nothing else to say', () => {
    const report = { passed: 3, failed: 0, skipped: 0, retried: [], reasons: [] };
    expect(summary([report], true)).toBe('3 passed, 0 failed, 0 skipped');
  });

  it('counts a fault outside the tests as a failure', () => {
    expect(summary([], false)).toBe('0 passed, 1 failed, 0 skipped');
    expect(summary([noReport], false)).toBe('0 passed, 1 failed, 0 skipped');
  });
});
