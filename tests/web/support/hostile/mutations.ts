/** Damaged copies of a file for tests of its reader: the same for the same seed. */

/** Cases per reader: 1,000, or what the environment variable FUZZ_CASES says. */
export const FUZZ_CASES = Number(process.env.FUZZ_CASES ?? 1000);
/** Most processor time that a reader may take for one case, seconds. */
export const MAX_CASE_SECONDS = 2;

/** Random whole numbers below a bound (mulberry32). */
export type Random = (bound: number) => number;

export function randomOf(seed: number): Random {
  let state = seed;
  return (bound) => {
    state = (state + 0x6d2b79f5) | 0;
    let t = Math.imul(state ^ (state >>> 15), 1 | state);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) % bound;
  };
}

/** Tokens that stand for a number or a name where they should not. */
const TOKENS = [
  ...['NaN', 'Infinity', '-1', '0', '2.5', '1e9', '1e999', '-1e6', '99999', '1,5', '0x10', ''],
  ...['{', '}', '<img src=x onerror=alert(1)>', '__proto__', 'constructor', '\u0000', 'é\u202e'],
];

const pick = <T>(items: readonly T[], random: Random): T => items[random(items.length)]!;

/** A text with one to three damages. */
export function damagedText(text: string, random: Random): string {
  let out = text;
  for (let times = 1 + random(3); times > 0; times--) out = pick(TEXT_DAMAGES, random)(out, random);
  return out;
}

const TEXT_DAMAGES: readonly ((text: string, random: Random) => string)[] = [
  (text, random) => text.slice(0, random(text.length + 1)),
  (text, random) => {
    const at = random(text.length + 1);
    return text.slice(0, at) + String.fromCharCode(random(256)) + text.slice(at + 1);
  },
  (text, random) =>
    changedTokens(text, (tokens) => void (tokens[random(tokens.length)] = pick(TOKENS, random))),
  (text, random) =>
    changedTokens(text, (tokens) => {
      const [a, b] = [random(tokens.length), random(tokens.length)];
      [tokens[a], tokens[b]] = [tokens[b]!, tokens[a]!];
    }),
  (text, random) => changedLines(text, (lines) => void lines.splice(random(lines.length), 1 + random(3))),
  (text, random) =>
    changedLines(text, (lines) => {
      const at = random(lines.length);
      lines.splice(random(lines.length), 0, ...lines.slice(at, at + 1 + random(3)));
    }),
];

function changedTokens(text: string, change: (tokens: string[]) => void): string {
  // Odd places are the white space between the tokens.
  const parts = text.split(/(\s+)/);
  const tokens = parts.filter((_, i) => i % 2 === 0);
  change(tokens);
  return parts.map((part, i) => (i % 2 === 0 ? tokens[i / 2]! : part)).join('');
}

function changedLines(text: string, change: (lines: string[]) => void): string {
  const lines = text.split('\n');
  change(lines);
  return lines.join('\n');
}

/** Bytes with flipped, overwritten, missing or repeated parts. */
export function damagedBytes(bytes: Uint8Array, random: Random): Uint8Array {
  const out = bytes.slice();
  switch (random(4)) {
    case 0:
      return out.slice(0, random(out.length));
    case 1:
      return Uint8Array.from([...out.subarray(0, random(out.length)), ...out.subarray(random(out.length))]);
    case 2: // 0xff and 0x7f make NaN, infinity and huge counts.
      out.fill(pick([0, 0x7f, 0x80, 0xff], random), random(out.length), random(out.length) + 4);
      return out;
    default:
      for (let times = 1 + random(8); times > 0; times--) out[random(out.length)]! ^= 1 << random(8);
      return out;
  }
}

const VALUES: readonly unknown[] = [
  ...[null, true, '', 'NaN', [], {}, 0, -1, 2.5, 1e9, 1e300, Infinity, NaN, Number.MIN_VALUE],
  ...['<img src=x onerror=alert(1)>', '__proto__', '../../x', 'x'.repeat(10_000)],
];

/** A deep copy of JSON in which one to three values are replaced, removed, repeated or nested deeply. */
export function damagedJson(json: unknown, random: Random): unknown {
  const root = { json: structuredClone(json) };
  for (let times = 1 + random(3); times > 0; times--) {
    const places: { holder: Record<string, unknown>; key: string }[] = [];
    const visit = (holder: unknown, depth: number): void => {
      if (typeof holder !== 'object' || holder === null || depth > 20) return;
      // Of a long list a few places stand for all.
      for (const key of Object.keys(holder).slice(0, 30)) {
        places.push({ holder: holder as Record<string, unknown>, key });
        visit((holder as Record<string, unknown>)[key], depth + 1);
      }
    };
    visit(root, 0);
    if (places.length === 0) break;
    const { holder, key } = pick(places, random);
    const value = holder[key];
    const kind = random(8);
    if (kind === 0) Reflect.deleteProperty(holder, key);
    else if (kind === 1 && Array.isArray(value)) value.push(...(structuredClone(value) as unknown[]));
    else if (kind === 2) holder[key] = nested(value);
    else if (kind === 3 && typeof value === 'number')
      holder[key] = value * pick([-1, 1000, 1e6, 1e-6], random);
    else holder[key] = pick(VALUES, random);
  }
  return root.json;
}

function nested(value: unknown): unknown {
  let out = value;
  for (let depth = 0; depth < 1000; depth++) out = [out];
  return out;
}
