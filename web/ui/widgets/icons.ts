/** Icons, each a list of paths in a box of 16; a leading `f ` fills, a leading `b ` is bolder. */
const PATHS = {
  song: [
    'M6 12V3.5l7-1.3v8.3',
    'M2.6 12a1.7 1.7 0 1 0 3.4 0a1.7 1.7 0 1 0-3.4 0',
    'M9.6 10.5a1.7 1.7 0 1 0 3.4 0a1.7 1.7 0 1 0-3.4 0',
  ],
  leader: [
    'M6.4 3.2a1.6 1.6 0 1 0 3.2 0a1.6 1.6 0 1 0-3.2 0',
    'M8 5.3v4.2m0 0-2.3 4.3M8 9.5l2.3 4.3M3.5 6.5 8 6.1l4.5-1.3',
  ],
  keyboard: [
    'M3.4 4h9.2a1.6 1.6 0 0 1 1.6 1.6v4.8a1.6 1.6 0 0 1-1.6 1.6H3.4a1.6 1.6 0 0 1-1.6-1.6V5.6A1.6 1.6 0 0 1 3.4 4z',
    'M4.3 6.7h.01M6.8 6.7h.01M9.3 6.7h.01M11.8 6.7h.01M5 9.5h6',
  ],
  theme: [
    'M5.2 8a2.8 2.8 0 1 0 5.6 0a2.8 2.8 0 1 0-5.6 0',
    'M8 1.8v1M8 13.2v1M1.8 8h1M13.2 8h1M3.6 3.6l.7.7M11.7 11.7l.7.7M12.4 3.6l-.7.7M4.3 11.7l-.7.7',
  ],
  download: ['M8 2.5v7.5m-3-3 3 3 3-3M3 13.3h10'],
  share: ['M8 10V2.5m-2.7 2.6L8 2.5l2.7 2.6M4.5 7.5h-1v6h9v-6h-1'],
  play: ['f M5 3.2v9.6c0 .5.5.8.9.5l7-4.8a.6.6 0 0 0 0-1L5.9 2.7c-.4-.3-.9 0-.9.5z'],
  pause: ['f M4.5 3h2.4v10H4.5zM9.1 3h2.4v10H9.1z'],
  start: ['M4 3.5v9', 'f M12.5 3.5v9L6 8z'],
  end: ['M12 3.5v9', 'f M3.5 3.5v9L10 8z'],
  loop: ['M3 7.5V6.5a2.5 2.5 0 0 1 2.5-2.5H13m-2-2 2 2-2 2M13 8.5v1a2.5 2.5 0 0 1-2.5 2.5H3m2 2-2-2 2-2'],
  undo: ['M3 6.5h6.5a3.2 3.2 0 0 1 0 6.5H6M3 6.5l2.7-2.7M3 6.5l2.7 2.7'],
  redo: ['M13 6.5H6.5a3.2 3.2 0 0 0 0 6.5H10m3-6.5-2.7-2.7M13 6.5l-2.7 2.7'],
  star: ['m8 2.3 1.75 3.55 3.9.57-2.82 2.75.67 3.9L8 11.23l-3.5 1.84.67-3.9L2.35 6.42l3.9-.57z'],
  rename: ['m3.2 12.8.6-2.6 6.9-6.9a1.2 1.2 0 0 1 1.7 0l.3.3a1.2 1.2 0 0 1 0 1.7l-6.9 6.9zM9.6 4.4l2 2'],
  remove: ['M3 4.5h10M6.3 4.5V3.2h3.4v1.3M4.3 4.5l.6 8.3h6.2l.6-8.3M6.8 7v3.5M9.2 7v3.5'],
  folder: ['M2.2 4.3a1 1 0 0 1 1-1h3l1.5 1.7h5.1a1 1 0 0 1 1 1v6a1 1 0 0 1-1 1H3.2a1 1 0 0 1-1-1z'],
  save: ['M3 2.8h8.2L13.2 5v8.2H3zM5.3 2.8v3.4h4.6V2.8M5.3 13.2V9.4h5.6v3.8'],
  reset: ['M3.2 8a4.8 4.8 0 1 0 1.5-3.5L3 6.1M3 3v3.1h3.1'],
  dice: [
    'M4.9 2.5h6.2a2.4 2.4 0 0 1 2.4 2.4v6.2a2.4 2.4 0 0 1-2.4 2.4H4.9a2.4 2.4 0 0 1-2.4-2.4V4.9a2.4 2.4 0 0 1 2.4-2.4z',
    'b M5.7 5.7h.01M10.3 5.7h.01M8 8h.01M5.7 10.3h.01M10.3 10.3h.01',
  ],
  minus: ['M4.5 8h7'],
  plus: ['M4.5 8h7M8 4.5v7'],
  frame: [
    'M2.5 5V3.5a1 1 0 0 1 1-1H5M11 2.5h1.5a1 1 0 0 1 1 1V5M13.5 11v1.5a1 1 0 0 1-1 1H11M5 13.5H3.5a1 1 0 0 1-1-1V11',
    'b M6.2 5.3h.01M9.8 5.3h.01M6.2 7.6v3M9.8 7.6v3',
  ],
  fit: ['M2.5 3.5v9M13.5 3.5v9M5 8h6M6.8 6 4.8 8l2 2M9.2 6l2 2-2 2'],
  lock: [
    'M5 7h6a1.5 1.5 0 0 1 1.5 1.5V12a1.5 1.5 0 0 1-1.5 1.5H5A1.5 1.5 0 0 1 3.5 12V8.5A1.5 1.5 0 0 1 5 7z',
    'M5.5 7V5a2.5 2.5 0 0 1 5 0v2',
  ],
  unlock: [
    'M5 7h6a1.5 1.5 0 0 1 1.5 1.5V12a1.5 1.5 0 0 1-1.5 1.5H5A1.5 1.5 0 0 1 3.5 12V8.5A1.5 1.5 0 0 1 5 7z',
    'M5.5 7V4.5a2.5 2.5 0 0 1 4.8-1',
  ],
  swap: ['M3 5.3h9.5m-2.4-2.4 2.4 2.4-2.4 2.4M13 10.7H3.5m2.4-2.4-2.4 2.4 2.4 2.4'],
  check: ['m3.5 8.3 3 3 6-6.5'],
  fold: ['m4.5 6.3 3.5 3.5 3.5-3.5'],
  unfold: ['m6 4 4 4-4 4'],
  close: ['m4.5 4.5 7 7m0-7-7 7'],
  device: ['M3.6 3h8.8v7H3.6zM1.8 12.8h12.4'],
  shield: ['M8 2 3.2 3.8v3.7c0 3 2 5.3 4.8 6.5 2.8-1.2 4.8-3.5 4.8-6.5V3.8z', 'm5.9 8 1.5 1.5 2.7-3'],
} as const;

export type IconName = keyof typeof PATHS;

const SVG = 'http://www.w3.org/2000/svg';

/** An SVG element of the given box with the given paths; a path is its data and, if any, its class. */
export function drawing(
  box: string,
  className: string,
  paths: readonly (readonly [string, string?])[],
): SVGSVGElement {
  const svg = document.createElementNS(SVG, 'svg');
  svg.setAttribute('viewBox', box);
  svg.setAttribute('class', className);
  svg.setAttribute('aria-hidden', 'true');
  for (const [data, pathClass] of paths) {
    const path = document.createElementNS(SVG, 'path');
    path.setAttribute('d', data);
    if (pathClass) path.setAttribute('class', pathClass);
    svg.append(path);
  }
  return svg;
}

/** One icon of the set. Icons are decoration: the button around them has the label. */
export function icon(name: IconName): SVGSVGElement {
  const paths = PATHS[name].map((path): [string, string?] => {
    if (path.startsWith('f ')) return [path.slice(2), 'f'];
    if (path.startsWith('b ')) return [path.slice(2), 'bold'];
    return [path];
  });
  return drawing('0 0 16 16', 'i', paths);
}

/** The brand mark: the leader's arc around the reactor's. */
export function brandMark(): SVGSVGElement {
  const svg = drawing('0 0 24 24', '', [
    ['M15.5 4.2A8.3 8.3 0 1 0 15.5 19.8', 'outer'],
    ['M10.5 8.6a4 4 0 1 1 0 6.8', 'inner'],
  ]);
  for (const path of svg.children) path.setAttribute('transform', 'rotate(-28 12 12)');
  return svg;
}
