import { HINT_EXPORT_AGAIN, numberProblem, numberHint } from './number';
import { AppError } from '../../../common/error';
import type { SourceJoint } from '../../retarget/source';

/** One joint or end site of the hierarchy, in the order of the file; an end site is named after its parent. */
export interface BvhNode extends SourceJoint {
  readonly offset: readonly [number, number, number];
  /** Channel names in the file's order and usual spelling ('Xposition', 'Zrotation', ...). */
  readonly channels: readonly string[];
}

const CHANNELS = ['Xposition', 'Yposition', 'Zposition', 'Xrotation', 'Yrotation', 'Zrotation'];

/** Largest depth of the hierarchy; the longest tails and cloaks have a few dozen joints in a row. */
const MAX_DEPTH = 300;
/** Largest number of joints and end sites: bodies with fingers, face and clothes have some hundreds. */
const MAX_NODES = 1000;

/** Reads the tokens of the hierarchy in order, with the line number of each. */
class TokenReader {
  private readonly tokens: { text: string; line: number }[] = [];
  private position = 0;

  constructor(lines: readonly string[], end: number) {
    let nodes = 0;
    for (let line = 0; line < end; line++) {
      const spaced = lines[line]!.replaceAll(/[{}]/g, ' $& ');
      for (const text of spaced.split(/\s+/)) {
        if (text !== '') this.tokens.push({ text, line: line + 1 });
        if (text === '{' && ++nodes > MAX_NODES) throw tooManyNodes(line + 1);
      }
    }
  }

  get line(): number {
    return (this.tokens[this.position] ?? this.tokens.at(-1))?.line ?? 1;
  }

  peek(): string | undefined {
    return this.tokens[this.position]?.text;
  }

  next(): string | undefined {
    return this.tokens[this.position++]?.text;
  }

  /** All tokens up to the end of the line or a brace: the name of a joint may contain spaces. */
  restOfLine(): string {
    const line = this.tokens[this.position - 1]?.line;
    const rest: string[] = [];
    while (this.tokens[this.position]?.line === line && this.peek() !== '{' && this.peek() !== '}') {
      rest.push(this.next()!);
    }
    return rest.join(' ');
  }
}

function tooManyNodes(line: number): AppError {
  return new AppError(
    'bad-hierarchy',
    `Line ${line}: the skeleton has more than ${MAX_NODES} joints.`,
    'Export the body alone, without cloth, hair and props.',
  );
}

/** The error of a file that ends too early, as after an interrupted download. */
export function truncated(message: string): AppError {
  return new AppError('truncated', message, 'The file is incomplete: download, copy or export it again.');
}

/**
 * Reads the skeleton in lines[0] to lines[end - 1], which begin with HIERARCHY.
 *
 * @throws {AppError} `truncated`, `bad-hierarchy` or `bad-number`
 */
export function readHierarchy(lines: readonly string[], end: number): BvhNode[] {
  const tokens = new TokenReader(lines, end);
  tokens.next();
  const nodes: BvhNode[] = [];
  const invalid = (what: string): AppError =>
    tokens.peek() === undefined && end === lines.length
      ? truncated(`The file ends at line ${tokens.line}, in the middle of the skeleton.`)
      : new AppError('bad-hierarchy', `Line ${tokens.line}: ${what}.`, HINT_EXPORT_AGAIN);

  const numbers = (count: number, what: string): number[] =>
    Array.from({ length: count }, () => {
      const token = tokens.peek();
      if (token === undefined) throw invalid(`${what} is incomplete`);
      const wrong = numberProblem(token);
      if (wrong !== null) {
        throw new AppError('bad-number', `Line ${tokens.line}: in ${what}, ${wrong}.`, numberHint(token));
      }
      tokens.next();
      return Number(token);
    });

  const readChannel = (name: string): string => {
    const token = tokens.peek();
    const channel = CHANNELS.find((known) => known.toLowerCase() === token?.toLowerCase());
    if (channel === undefined)
      throw invalid(`"${token ?? ''}" in ${name} is not a channel of position or rotation`);
    return channel;
  };

  const readChannels = (name: string): string[] => {
    if (tokens.peek()?.toUpperCase() !== 'CHANNELS') return [];
    tokens.next();
    const [count] = numbers(1, `the CHANNELS of ${name}`) as [number];
    if (!Number.isInteger(count) || count < 0 || count > CHANNELS.length)
      throw invalid(`${name} has ${count} channels; a joint has 0 to ${CHANNELS.length}`);
    const channels: string[] = [];
    while (channels.length < count) {
      const channel = readChannel(name);
      if (channels.includes(channel)) throw invalid(`${name} has the channel ${channel} twice`);
      channels.push(channel);
      tokens.next();
    }
    return channels;
  };

  const readNode = (parent: number, endSite: boolean, depth: number): void => {
    if (depth > MAX_DEPTH) throw invalid(`joints are nested more than ${MAX_DEPTH} deep`);
    const written = tokens.restOfLine();
    const name = endSite ? `end of ${nodes[parent]!.name}` : written;
    if (name === '') throw invalid('a joint has no name');
    if (tokens.next() !== '{') throw invalid(`expected "{" after ${name}`);
    if (tokens.next()?.toUpperCase() !== 'OFFSET') throw invalid(`${name} has no OFFSET`);
    const offset = numbers(3, `the OFFSET of ${name}`) as [number, number, number];
    const index = nodes.push({ name, endSite, parent, offset, channels: readChannels(name) }) - 1;
    for (;;) {
      const keyword = tokens.next()?.toUpperCase();
      if (keyword === '}') return;
      if (keyword === 'JOINT') readNode(index, false, depth + 1);
      else if (keyword === 'END') readNode(index, true, depth + 1);
      else if (keyword === undefined) throw invalid(`"}" of ${name} is missing`);
      else throw invalid(`expected JOINT, End Site or "}" in ${name}, found "${keyword}"`);
    }
  };

  while (tokens.peek() !== undefined) {
    if (tokens.peek()!.toUpperCase() !== 'ROOT') throw invalid(`expected ROOT, found "${tokens.peek()!}"`);
    tokens.next();
    readNode(-1, false, 0);
  }
  if (nodes.length === 0) throw invalid('there is no ROOT');
  return nodes;
}
