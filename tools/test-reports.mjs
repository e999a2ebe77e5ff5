/**
 * What the reports of the three test runners say, for the summary of `npm test`.
 *
 * @typedef {object} Report
 * @property {number} passed tests, those of a second try among them
 * @property {number} failed
 * @property {number} skipped
 * @property {string[]} retried names of the tests that passed on a second try only
 * @property {string[]} reasons one for each skipped test whose runner reports it
 */

/** @type {Report} What is counted for a runner that ended without a report. */
export const noReport = { passed: 0, failed: 1, skipped: 0, retried: [], reasons: [] };

/** @param {string} report vitest's JSON @returns {Report} */
export function readVitest(report) {
  const result = JSON.parse(report);
  /** @type {{ assertionResults: { status: string, fullName: string }[] }[]} */
  const files = result.testResults;
  const tests = files.flatMap((file) => file.assertionResults);
  return {
    passed: result.numPassedTests,
    // A file that can't be loaded has no tests to fail.
    failed: Math.max(result.numFailedTests, result.success ? 0 : 1),
    skipped: result.numPendingTests + result.numTodoTests,
    // vitest.config.ts allows no second try.
    retried: [],
    // The report holds no reasons; our skipped tests have theirs in their names.
    reasons: tests
      .filter(({ status }) => status !== 'passed' && status !== 'failed')
      .map((test) => test.fullName),
  };
}

/** @param {string} report pytest's JUnit XML @returns {Report} */
export function readPytest(report) {
  const suite = /<testsuite [^>]*>/.exec(report)?.[0] ?? '';
  /** @param {string} name */
  const number = (name) => Number(new RegExp(`\\b${name}="(\\d+)"`).exec(suite)?.[1] ?? 0);
  const failed = number('failures') + number('errors');
  return {
    passed: number('tests') - failed - number('skipped'),
    failed,
    skipped: number('skipped'),
    // pytest has no second try.
    retried: [],
    reasons: [...report.matchAll(/<skipped [^>]*\bmessage="([^"]*)"/g)].map(([, reason = '']) =>
      unescape(reason),
    ),
  };
}

/** @param {string} text an attribute of XML */
function unescape(text) {
  /** @type {Record<string, string>} */
  const characters = { lt: '<', gt: '>', quot: '"', apos: "'", amp: '&' };
  return text.replace(/&(lt|gt|quot|apos|amp);/g, (_, name) => characters[name] ?? '');
}

/** @param {string} report Playwright's JSON @returns {Report} */
export function readPlaywright(report) {
  /** @type {{ stats: Record<'expected' | 'flaky' | 'unexpected' | 'skipped', number>, errors: [], suites: Suite[] }} */
  const { stats, errors, suites } = JSON.parse(report);
  const tests = suites.flatMap((suite) => testsOf(suite, []));
  return {
    passed: stats.expected + stats.flaky,
    failed: stats.unexpected + errors.length,
    skipped: stats.skipped,
    retried: tests.filter((test) => test.status === 'flaky').map((test) => test.name),
    reasons: tests.filter((test) => test.status === 'skipped').map((test) => test.reason ?? test.name),
  };
}

/**
 * @typedef {object} Suite a file or a group of tests in Playwright's report
 * @property {string} title of a file its path
 * @property {Suite[]} [suites]
 * @property {{ title: string, tests: SpecTest[] }[]} specs
 *
 * @typedef {{ status: string, annotations: { type: string, description?: string }[] }} SpecTest
 */

/**
 * All tests of a suite and of the suites in it.
 *
 * @param {Suite} suite
 * @param {string[]} above titles of the suites around it
 * @returns {{ name: string, status: string, reason: string | undefined }[]} named as in 'file.spec.ts › group › test'
 */
function testsOf(suite, above) {
  const titles = [...above, suite.title];
  const own = suite.specs.flatMap((spec) =>
    spec.tests.map(({ status, annotations }) => ({
      name: [...titles, spec.title].join(' › '),
      status,
      reason: annotations.find(({ type }) => type === 'skip')?.description,
    })),
  );
  return [...own, ...(suite.suites ?? []).flatMap((inner) => testsOf(inner, titles))];
}

/**
 * The last lines of `npm test`: why tests were skipped, which ones needed a second try, and the counts.
 *
 * @param {Report[]} reports
 * @param {boolean} faultless false when a step has failed
 * @returns {string}
 */
export function summary(reports, faultless) {
  /** @param {'passed' | 'failed' | 'skipped'} outcome */
  const total = (outcome) => reports.reduce((sum, report) => sum + report[outcome], 0);
  /** @type {Map<string, number>} */
  const reasons = new Map();
  for (const reason of reports.flatMap((report) => report.reasons))
    reasons.set(reason, (reasons.get(reason) ?? 0) + 1);
  // A fault outside the tests (format, types, build) is a failure too, though no test has seen it.
  const failed = faultless ? 0 : Math.max(1, total('failed'));
  return [
    ...[...reasons].map(([reason, count]) => `skipped: ${count} x ${reason}`),
    ...reports.flatMap((report) => report.retried).map((name) => `needed a second try: ${name}`),
    `${total('passed')} passed, ${failed} failed, ${total('skipped')} skipped`,
  ].join('\n');
}
