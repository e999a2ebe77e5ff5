/** Time and memory over the length of a dance, as SVG. */

const PANEL = { width: 300, height: 180, left: 44, top: 28 };

/**
 * @param {readonly import('./lengths.mjs').Length[]} lengths ascending
 * @returns {string}
 */
export function plotLengths(lengths) {
  const panels = [
    panel('seconds until the partner dances', lengths, ({ song, leader, dance }) => song + leader + dance),
    panel('most memory of the page’s processes, MB', lengths, ({ memory }) => memory),
  ];
  const width = panels.length * (PANEL.width + 2 * PANEL.left);
  const height = PANEL.height + PANEL.top + 40;
  const placed = panels.map(
    (content, i) =>
      `<g transform="translate(${i * (PANEL.width + 2 * PANEL.left) + PANEL.left},${PANEL.top})">${content}</g>`,
  );
  return [
    `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${width} ${height}" width="${width}" height="${height}"`,
    ` font-family="sans-serif" font-size="11" fill="#333">`,
    `<rect width="${width}" height="${height}" fill="#fff"/>${placed.join('')}</svg>\n`,
  ].join('');
}

/**
 * @param {string} title
 * @param {readonly import('./lengths.mjs').Length[]} lengths
 * @param {(length: import('./lengths.mjs').Length) => number} valueOf
 */
function panel(title, lengths, valueOf) {
  const values = lengths.map(valueOf);
  const [longest, most] = [lengths.at(-1)?.minutes ?? 1, Math.max(...values)];
  /** @param {number} minutes */
  const x = (minutes) => ((minutes / longest) * PANEL.width).toFixed(1);
  /** @param {number} value */
  const y = (value) => (PANEL.height * (1 - value / most)).toFixed(1);
  const points = lengths.map(({ minutes }, i) => [x(minutes), y(values[i] ?? 0)]);
  return [
    `<text y="-12" font-weight="bold">${title}</text>`,
    `<path d="M0 0V${PANEL.height}H${PANEL.width}" fill="none" stroke="#999"/>`,
    `<path d="M${points.map((point) => point.join(' ')).join('L')}" fill="none" stroke="#2a6fb0" stroke-width="2"/>`,
    ...points.map(([px, py]) => `<circle cx="${px}" cy="${py}" r="3" fill="#2a6fb0"/>`),
    ...points.map(
      ([px, py], i) =>
        `<text x="${px}" y="${Number(py) - 8}" text-anchor="end">${(values[i] ?? 0).toFixed(0)}</text>`,
    ),
    ...lengths.map(
      ({ minutes }) =>
        `<text x="${x(minutes)}" y="${PANEL.height + 16}" text-anchor="middle">${minutes} min</text>`,
    ),
  ].join('');
}
