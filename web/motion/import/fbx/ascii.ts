import { damagedFbx, FbxBudget, type FbxNode, type FbxValue, isSkipped } from './node';

/** Tokens of the text form: a name with its colon, a string, braces, commas, and words or numbers. Comments begin with ;. */
const TOKEN = /;[^\n]*|"([^"]*)"|(\w+):|[{},]|[^\s{},"]+/g;

/**
 * Reads the text form of FBX; meshes, materials and pictures are left out.
 *
 * @throws {AppError} `unreadable-file`
 */
export function readAscii(text: string): FbxNode[] {
  const budget = new FbxBudget();
  const root: FbxNode = { name: '', values: [], children: [] };
  const open: FbxNode[] = [root];
  let current: FbxNode | null = null;
  /** Depth in `open` of the part that is left out; 0 while all is kept. */
  let skipped = 0;
  for (const [token, string, name] of text.matchAll(TOKEN)) {
    if (token.startsWith(';') || token === ',') continue;
    if (name !== undefined) {
      budget.node(open.length - 1);
      current = { name, values: [], children: [] };
      if (skipped === 0) open.at(-1)!.children.push(current);
    } else if (token === '{') {
      if (current === null) throw damagedFbx('a brace opens nothing');
      open.push(current);
      if (skipped === 0 && isSkipped(current.name)) skipped = open.length;
      current = null;
    } else if (token === '}') {
      if (open.length === 1) throw damagedFbx('a brace closes nothing');
      if (skipped === open.length) skipped = 0;
      open.pop();
      current = null;
    } else if (current !== null && skipped === 0) {
      budget.array(1);
      current.values.push(valueOf(token, string));
    }
  }
  if (open.length > 1) throw damagedFbx('it ends too early');
  return root.children;
}

function valueOf(token: string, string: string | undefined): FbxValue {
  if (string !== undefined) return string;
  const number = Number(token);
  const isRounded = /^-?\d+$/.test(token) && !Number.isSafeInteger(number);
  return Number.isNaN(number) || isRounded ? token : number;
}
