/** The stages of a dance from song and leader to the solved partner. */
export const STAGES = /** @type {const} */ (['features', 'condition', 'steps', 'decode', 'solve']);

/**
 * Steps of all three branches, of which `steps` has the conditional one; and after a change of a weight, until the part
 * in view is there and until the whole dance is.
 */
const BESIDE = /** @type {const} */ (['branches', 'preview', 'renewed']);

/** The stages that every backend has: the graphs. */
const GRAPH_STAGES = /** @type {const} */ (['condition', 'steps', 'decode']);

/**
 * @typedef {object} Row
 * @property {string} backend
 * @property {number} threads
 * @property {Partial<Record<typeof STAGES[number] | typeof BESIDE[number], number>>} seconds, median over runs; the
 *   browser's steps include the condition graph, Python has no solver
 * @property {Partial<Record<typeof STAGES[number], number>>} [first] seconds of the first run after loading
 * @property {number} [load] seconds of fetching, opening and warming up
 */

/**
 * @param {Row['seconds']} seconds
 * @param {readonly (typeof STAGES[number])[]} [stages]
 */
function total(seconds, stages = STAGES) {
  return stages.reduce((sum, stage) => sum + (seconds[stage] ?? 0), 0);
}

/**
 * Adds to each row its total and how many times as long its graphs took as those of the two references.
 *
 * @template {Row} T
 * @param {T[]} rows
 */
export function withRatios(rows) {
  /** @param {string} backend */
  const reference = (backend) => {
    const row = rows.find((candidate) => candidate.backend === backend);
    return row === undefined ? NaN : total(row.seconds, GRAPH_STAGES);
  };
  const [eager, native] = [reference('PyTorch eager'), reference('onnxruntime native')];
  return rows.map((row) => {
    const graphs = total(row.seconds, GRAPH_STAGES);
    return { ...row, total: total(row.seconds), toEager: graphs / eager, toNative: graphs / native };
  });
}

/**
 * @param {ReturnType<typeof withRatios>} rows
 * @returns {string} a table in Markdown
 */
export function table(rows) {
  const head = ['backend', 'threads', ...STAGES, 'total', 'first run', '/ PyTorch', '/ native', ...BESIDE];
  /** @param {number | undefined} value */
  const number = (value) => (value === undefined ? '-' : value.toFixed(2));
  const body = rows.map((row) => [
    row.backend,
    String(row.threads),
    ...STAGES.map((stage) => number(row.seconds[stage])),
    number(row.total),
    number(row.first === undefined ? undefined : total(row.first)),
    number(row.toEager),
    number(row.toNative),
    ...BESIDE.map((name) => number(row.seconds[name])),
  ]);
  const lines = [head, head.map(() => '---'), ...body];
  const widths = head.map((_, column) => Math.max(...lines.map((line) => line[column]?.length ?? 0)));
  return lines
    .map((line) => `| ${line.map((cell, i) => cell.padEnd(widths[i] ?? 0)).join(' | ')} |`)
    .join('\n');
}
