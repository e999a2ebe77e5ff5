import type { Theme } from '../../common/picture';
import { LOOKS } from '../../view/theme';

/** What is written into a video; empty for nothing. */
export interface Captions {
  readonly title: string;
  readonly credit: string;
}

/** How long the title stays, and the end of it during which it fades, seconds. */
const TITLE = { seconds: 4, fade: 0.6 };
/** Most lines of each, and the distance of two lines as a multiple of the letters' height. */
const LINES = { title: 3, credit: 2, distance: 1.25 };
/** Heights of the letters and distance from the edge, shares of the shorter side of the picture. */
const SIZES = { title: 0.055, credit: 0.026, edge: 0.045 };
const FONT = '"Hanken Grotesk", system-ui, sans-serif';

/** Opacity of the title at a moment of the video, 0 to 1. */
export function titleOpacity(seconds: number): number {
  return Math.min(1, Math.max(0, (TITLE.seconds - seconds) / TITLE.fade));
}

/** The longest beginning of a text that is not wider than `width`, with an ellipsis where it is cut. */
export function fitted(text: string, width: number, widthOf: (text: string) => number): string {
  if (widthOf(text) <= width) return text;
  // Not by the units of the string, of which an emoji has several.
  const letters = Array.from(new Intl.Segmenter().segment(text), ({ segment }) => segment);
  const beginning = (end: number): string => `${letters.slice(0, end).join('').trimEnd()}…`;
  let end = letters.length - 1;
  while (end > 0 && widthOf(beginning(end)) > width) end--;
  return beginning(end);
}

/** Of scripts that have no spaces between words. */
const UNSPACED =
  /[\p{Script=Han}\p{Script=Hiragana}\p{Script=Katakana}\p{Script=Thai}\p{Script=Lao}\p{Script=Khmer}\p{Script=Myanmar}]/u;

/** The parts of a text after which a line may end; a space is at the beginning of the part behind it. */
function parts(text: string): string[] {
  return text
    .trim()
    .split(/\s+/)
    .flatMap((word, index) => {
      const [first = '', ...rest] = UNSPACED.test(word) ? wordsWithoutSpaces(word) : [word];
      return [index === 0 ? first : ` ${first}`, ...rest];
    });
}

/** Words with the signs that follow them, with which no line begins. */
function wordsWithoutSpaces(text: string): string[] {
  const words: string[] = [];
  const segments = new Intl.Segmenter(undefined, { granularity: 'word' }).segment(text);
  for (const { segment, isWordLike } of segments)
    if (isWordLike || words.length === 0) words.push(segment);
    else words.push(`${words.pop()!}${segment}`);
  return words;
}

/** Whether a text is written from right to left: its first letter is. */
const RIGHT_TO_LEFT =
  /^\P{L}*[\p{Script=Arabic}\p{Script=Hebrew}\p{Script=Syriac}\p{Script=Thaana}\p{Script=Nko}]/u;

/** A text in lines that are not wider than `width`, at most `most` of them; what is left over is cut as in `fitted`. */
export function wrapped(
  text: string,
  width: number,
  most: number,
  widthOf: (text: string) => number,
): readonly string[] {
  const lines: string[] = [];
  const all = parts(text);
  for (const [index, part] of all.entries()) {
    const last = lines.at(-1);
    const longer = last === undefined ? part : `${last}${part}`;
    if (last !== undefined && widthOf(longer) <= width) lines[lines.length - 1] = longer;
    else if (lines.length < most) lines.push(part.trimStart());
    else {
      lines[lines.length - 1] = [last, ...all.slice(index)].join('');
      break;
    }
  }
  return lines.map((line) => fitted(line, width, widthOf));
}

/**
 * Pictures with a title in their first seconds and a credit line at the bottom. Without either they are the pictures
 * themselves, which are not copied.
 *
 * @returns the canvas to write, and a function that copies the present picture, of the moment `seconds`, to it
 */
export function captioned(
  picture: HTMLCanvasElement,
  { title, credit }: Captions,
  theme: Theme,
): { readonly canvas: HTMLCanvasElement; readonly draw: (seconds: number) => void } {
  if (title.trim() === '' && credit.trim() === '') return { canvas: picture, draw: () => undefined };
  const canvas = document.createElement('canvas');
  const context = canvas.getContext('2d', { alpha: false });
  if (!context) return { canvas: picture, draw: () => undefined };
  const { width, height } = Object.assign(canvas, { width: picture.width, height: picture.height });
  const side = Math.min(width, height);
  const edge = SIZES.edge * side;
  /** Writes below the upper edge or, with the last line there, above the lower one. */
  const write = (what: 'title' | 'credit', text: string, weight: number, opacity: number): void => {
    const letters = SIZES[what] * side;
    context.font = `${weight} ${Math.round(letters)}px ${FONT}`;
    context.globalAlpha = opacity;
    const isReversed = RIGHT_TO_LEFT.test(text);
    // Text is aligned at its start.
    context.direction = isReversed ? 'rtl' : 'ltr';
    const lines = wrapped(text, width - 2 * edge, LINES[what], (part) => context.measureText(part).width);
    lines.forEach((line, index) => {
      const below = what === 'title' ? index : index - (lines.length - 1);
      const y = (what === 'title' ? edge + letters : height - edge) + LINES.distance * letters * below;
      context.fillText(line, isReversed ? width - edge : edge, y);
    });
  };
  return {
    canvas,
    draw: (seconds) => {
      context.globalAlpha = 1;
      context.drawImage(picture, 0, 0);
      context.fillStyle = `#${LOOKS[theme].contrast.toString(16).padStart(6, '0')}`;
      context.textBaseline = 'alphabetic';
      write('title', title, 600, titleOpacity(seconds));
      write('credit', credit, 500, 1);
    },
  };
}
