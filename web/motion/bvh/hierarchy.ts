import { AGAIN, complaint, numberHint } from './number';
import { AppError } from '../../common/error';

/** One joint or end site of the hierarchy, in the order of the file. */
export interface BvhNode {
  /** Name as written; an end site is called after its parent. */
  readonly name: string;
  readonly endSite: boolean;
  /** Index of the parent node, -1 for the root. */
  readonly parent: number;
  readonly offset: readonly [number, number, number];
  /** Channel names in the file's order and usual spelling ('Xposition', 'Zrotation', ...). */
  readonly channels: readonly string[];
}

const CHANNELS = ['Xposition', 'Yposition', 'Zposition', 'Xrotation', 'Yrotation', 'Zrotation'];

/** Joints in a row; the longest tails and cloaks have a few dozen. */
const DEEPEST = 300;

/** Walks over the words of the hierarchy and knows the line of each. */
class Words {
  private readonly words: { text: string; line: number }[] = [];
  private at = 0;

  constructor(lines: readonly string[], end: number) {
    for (let line = 0; line < end; line++) {
      const spaced = lines[line]!.replaceAll(/[{}]/g, ' $& ');
      for (const text of spaced.split(/\s+/)) if (text !== '') this.words.push({ text, line: line + 1 });
    }
  }

  get line(): number {
    return (this.words[this.at] ?? this.words.at(-1))?.line ?? 1;
  }

  peek(): string | undefined {
    return this.words[this.at]?.text;
  }

  next(): string | undefined {
    return this.words[this.at++]?.text;
  }

  /** All words up to the end of the line or a brace: the name of a joint may hold spaces. */
  restOfLine(): string {
    const line = this.words[this.at - 1]?.line;
    const rest: string[] = [];
    while (this.words[this.at]?.line === line && this.peek() !== '{' && this.peek() !== '}') {
      rest.push(this.next()!);
    }
    return rest.join(' ');
  }
}

function cutOff(words: Words): AppError {
  return new AppError(
    'truncated',
    `The file ends at line ${words.line}, in the middle of the skeleton.`,
    'The file is incomplete: copy or export it again.',
  );
}

/**
 * Reads the skeleton in lines[0] to lines[end - 1], which begin with HIERARCHY.
 *
 * @throws {AppError} `truncated`, `bad-hierarchy`, `bad-number` or `several-roots`
 */
export function readHierarchy(lines: readonly string[], end: number): BvhNode[] {
  const words = new Words(lines, end);
  words.next();
  const nodes: BvhNode[] = [];
  const roots: { name: string; line: number }[] = [];
  const bad = (what: string): AppError =>
    words.peek() === undefined && end === lines.length
      ? cutOff(words)
      : new AppError('bad-hierarchy', `Line ${words.line}: ${what}.`, AGAIN);

  const numbers = (count: number, what: string): number[] =>
    Array.from({ length: count }, () => {
      const token = words.peek();
      if (token === undefined) throw bad(`${what} is incomplete`);
      const wrong = complaint(token);
      if (wrong !== null) {
        throw new AppError('bad-number', `Line ${words.line}: in ${what}, ${wrong}.`, numberHint(token));
      }
      words.next();
      return Number(token);
    });

  const readNode = (parent: number, endSite: boolean, depth: number): void => {
    if (depth > DEEPEST) throw bad(`joints hang on one another more than ${DEEPEST} deep`);
    const written = words.restOfLine();
    const name = endSite ? `end of ${nodes[parent]!.name}` : written;
    if (name === '') throw bad('a joint has no name');
    if (words.next() !== '{') throw bad(`expected "{" after ${name}`);
    if (words.next()?.toUpperCase() !== 'OFFSET') throw bad(`${name} has no OFFSET`);
    const [x, y, z] = numbers(3, `the OFFSET of ${name}`) as [number, number, number];
    const channels: string[] = [];
    if (words.peek()?.toUpperCase() === 'CHANNELS') {
      words.next();
      const [count] = numbers(1, `the CHANNELS of ${name}`) as [number];
      for (let i = 0; i < count; i++) {
        const word = words.peek();
        const channel = CHANNELS.find((known) => known.toLowerCase() === word?.toLowerCase());
        if (channel === undefined)
          throw bad(`"${word ?? ''}" in ${name} is no channel of position or rotation`);
        channels.push(channel);
        words.next();
      }
    }
    const index = nodes.push({ name, endSite, parent, offset: [x, y, z], channels }) - 1;
    for (;;) {
      const word = words.next()?.toUpperCase();
      if (word === '}') return;
      if (word === 'JOINT') readNode(index, false, depth + 1);
      else if (word === 'END') readNode(index, true, depth + 1);
      else if (word === undefined) throw bad(`"}" of ${name} is missing`);
      else throw bad(`expected JOINT, End Site or "}" in ${name}, found "${word}"`);
    }
  };

  while (words.peek() !== undefined) {
    if (words.peek()!.toUpperCase() !== 'ROOT') throw bad(`expected ROOT, found "${words.peek()!}"`);
    roots.push({ name: '', line: words.line });
    words.next();
    const first = nodes.length;
    readNode(-1, false, 0);
    roots.at(-1)!.name = nodes[first]!.name;
  }
  if (roots.length === 0) throw bad('there is no ROOT');
  if (roots.length > 1) {
    const where = roots.map(({ name, line }) => `${name} at line ${line}`).join(', ');
    throw new AppError(
      'several-roots',
      `The file holds ${roots.length} skeletons: ${where}.`,
      'Export one dancer per file: the one who leads.',
    );
  }
  return nodes;
}
