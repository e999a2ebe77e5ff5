/** The table of docs/leader-from-video.md. */
import { type Accuracy, accuracyOf, travels } from './accuracy';
import { FILMED, type FilmedMotion, PERSON } from './shots';

const HEAD = '| motion | camera, m | pose, mm | place | path | heading | planted feet, m/s |';
const RULE = '|---|---:|---:|---:|---:|---:|---:|';

/** The row of a filmed motion. */
export function tableRow(filmed: FilmedMotion, found: Accuracy): string {
  const away = travels(found, filmed);
  const percent = (share: number): string => `${Math.round(100 * share)} %`;
  const cells = [
    filmed.title,
    filmed.shot.position[1].toFixed(1),
    String(Math.round(1000 * found.pose)),
    away ? percent(found.place / found.travelled) : `${Math.round(1000 * found.place)} mm`,
    away ? percent(found.found / found.travelled) : '',
    `${Math.round((180 / Math.PI) * found.heading)}°`,
    found.feet.toFixed(2),
  ];
  return `| ${cells.join(' | ')} |`;
}

/** Made of the recordings. */
export function accuracyTable(): string {
  return [HEAD, RULE, ...[...FILMED, ...PERSON].map((filmed) => tableRow(filmed, accuracyOf(filmed)))].join(
    '\n',
  );
}

/** The document with another table. @throws when it has none */
export function withTable(document: string, table: string): string {
  const [before, rest] = [document.indexOf(HEAD), document.indexOf(RULE)];
  if (before < 0 || rest < 0) throw new Error('The document has no table of accuracy.');
  const after = document.indexOf('\n\n', rest);
  return `${document.slice(0, before)}${table}${document.slice(after)}`;
}
