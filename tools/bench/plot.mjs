/** Figures of measurements beside each other, as SVG. */

const PANEL = { width: 300, height: 180, left: 44, top: 28 };
const COLOURS = ['#2a6fb0', '#c05a1a', '#3f8a4a', '#7d4fa8', '#8a7a2a'];

/**
 * @typedef {object} Panel lines over the same values, from 0 up and from left to right
 * @property {string} title
 * @property {readonly { at: number, text: string }[]} ticks below
 * @property {readonly Line[]} lines those with names from the highest to the lowest
 */

/**
 * @typedef {object} Line
 * @property {string} [name] written at its end; without one each point has its value
 * @property {readonly (readonly [number, number])[]} points
 */

/** @param {readonly Panel[]} panels */
export function plot(panels) {
  const width = panels.length * (PANEL.width + 2 * PANEL.left);
  const height = PANEL.height + PANEL.top + 40;
  const placed = panels.map(
    (content, i) =>
      `<g transform="translate(${i * (PANEL.width + 2 * PANEL.left) + PANEL.left},${PANEL.top})">${draw(content)}</g>`,
  );
  return [
    `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${width} ${height}" width="${width}" height="${height}"`,
    ` font-family="sans-serif" font-size="11" fill="#333">`,
    `<rect width="${width}" height="${height}" fill="#fff"/>${placed.join('')}</svg>\n`,
  ].join('');
}

/** @param {Panel} panel */
function draw({ title, ticks, lines }) {
  const all = lines.flatMap(({ points }) => points);
  const [right, top] = [Math.max(...all.map(([at]) => at)), Math.max(...all.map(([, value]) => value))];
  /** @param {number} at */
  const x = (at) => ((at / right) * PANEL.width).toFixed(1);
  /** @param {number} value */
  const y = (value) => (PANEL.height * (1 - value / top)).toFixed(1);
  let lowest = -Infinity;
  return [
    `<text y="-12" font-weight="bold">${title}</text>`,
    `<path d="M0 0V${PANEL.height}H${PANEL.width}" fill="none" stroke="#999"/>`,
    ...lines.map(({ name, points }, i) => {
      const colour = COLOURS[i % COLOURS.length];
      const path = `M${points.map(([at, value]) => `${x(at)} ${y(value)}`).join('L')}`;
      /** @param {readonly [number, number]} point */
      const label = ([at, value]) => {
        const free = Number(y(value)) - 8;
        // Names stand one below the other: lines are named from the highest to the lowest.
        lowest = name === undefined ? free : Math.max(free, lowest + 12);
        return [
          `<text x="${x(at)}" y="${lowest.toFixed(1)}" text-anchor="end" fill="${name ? colour : '#333'}"`,
          ` stroke="#fff" stroke-width="3" paint-order="stroke">${name ?? ''} ${value.toFixed(0)}</text>`,
        ].join('');
      };
      const dots = name === undefined ? points : points.slice(-1);
      return [
        `<path d="${path}" fill="none" stroke="${colour}" stroke-width="2"/>`,
        ...dots.map(([at, value]) => `<circle cx="${x(at)}" cy="${y(value)}" r="3" fill="${colour}"/>`),
        ...dots.map(label),
      ].join('');
    }),
    ...ticks.map(
      ({ at, text }) => `<text x="${x(at)}" y="${PANEL.height + 16}" text-anchor="middle">${text}</text>`,
    ),
  ].join('');
}
