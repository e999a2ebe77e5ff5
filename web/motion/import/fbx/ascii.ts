import { damagedFbx, FbxBudget, type FbxNode, type FbxValue, isSkipped } from './node';

/** Tokens of the text form: a name with its colon, a string, braces, commas, and words or numbers. Comments begin with ;. */
const TOKEN = /;[^\n]*|"([^"]*)"|(\w+):|[{},]|[^\s{},"]+/g;

/** Puts the nodes of a file together while its tokens come. */
class TreeBuilder {
  private readonly budget = new FbxBudget();
  /** The nodes whose braces are open, from the root on. */
  private readonly open: FbxNode[] = [{ name: '', values: [], children: [] }];
  /** The node that values belong to; null after a brace. */
  private current: FbxNode | null = null;
  /** Depth in `open` of the part that is left out; 0 while all is kept. */
  private skipped = 0;

  beginNode(name: string): void {
    this.budget.node(this.open.length - 1);
    this.current = { name, values: [], children: [] };
    if (this.skipped === 0) this.open.at(-1)!.children.push(this.current);
  }

  openBrace(): void {
    if (this.current === null) throw damagedFbx('a brace opens nothing');
    this.open.push(this.current);
    if (this.skipped === 0 && isSkipped(this.current.name)) this.skipped = this.open.length;
    this.current = null;
  }

  closeBrace(): void {
    if (this.open.length === 1) throw damagedFbx('a brace closes nothing');
    if (this.skipped === this.open.length) this.skipped = 0;
    this.open.pop();
    this.current = null;
  }

  addValue(token: string, string: string | undefined): void {
    if (this.current === null || this.skipped > 0) return;
    this.budget.array(1);
    this.current.values.push(valueOf(token, string));
  }

  /** The nodes at the top, once all tokens have come. */
  finish(): FbxNode[] {
    if (this.open.length > 1) throw damagedFbx('it ends too early');
    return this.open[0]!.children;
  }
}

/**
 * Reads the text form of FBX; meshes, materials and pictures are left out.
 *
 * @throws {AppError} `unreadable-file`
 */
export function readAscii(text: string): FbxNode[] {
  const tree = new TreeBuilder();
  for (const [token, string, name] of text.matchAll(TOKEN)) {
    if (token.startsWith(';') || token === ',') continue;
    if (name !== undefined) tree.beginNode(name);
    else if (token === '{') tree.openBrace();
    else if (token === '}') tree.closeBrace();
    else tree.addValue(token, string);
  }
  return tree.finish();
}

function valueOf(token: string, string: string | undefined): FbxValue {
  if (string !== undefined) return string;
  const number = Number(token);
  const isRounded = /^-?\d+$/.test(token) && !Number.isSafeInteger(number);
  return Number.isNaN(number) || isRounded ? token : number;
}
