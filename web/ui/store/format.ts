/** `0:16.7`, the clock; `tenths: false` gives `0:16`. Seconds are cut, not rounded, as clocks do. */
export function clockTime(seconds: number, tenths = true): string {
  const total = Math.max(0, Math.floor(seconds * 10 + 1e-6));
  const minutes = Math.floor(total / 600);
  const rest = String(Math.floor((total % 600) / 10)).padStart(2, '0');
  return tenths ? `${minutes}:${rest}.${total % 10}` : `${minutes}:${rest}`;
}

/** `0:34`, a length as the clock shows it: below ten seconds with tenths. */
export function duration(seconds: number): string {
  return clockTime(seconds, seconds < 10);
}

/** `24.6 of 38.4 MB`; without a known total only what came so far. */
export function bytesOf(received: number, total: number): string {
  const megabytes = (value: number): string => (value / 1e6).toFixed(1);
  return total > 0 ? `${megabytes(received)} of ${megabytes(total)} MB` : `${megabytes(received)} MB`;
}

/** `0.9 MB` or `312 KB`. */
export function byteSize(bytes: number): string {
  return bytes >= 1e6 ? `${(bytes / 1e6).toFixed(1)} MB` : `${Math.max(1, Math.round(bytes / 1e3))} KB`;
}

/** `58 %`. */
export function percent(share: number): string {
  return `${Math.round(share * 100)} %`;
}

/** `1 take`, `3 takes`. */
export function counted(number: number, noun: string): string {
  return `${number} ${noun}${number === 1 ? '' : 's'}`;
}

/** With a capital first letter. */
export function capitalised(text: string): string {
  return text.charAt(0).toUpperCase() + text.slice(1);
}

/** Whole centimetres. */
export function centimetres(metres: number): number {
  return Math.round(metres * 100);
}

/** `29.97`, `60`: frame rates without needless zeros. */
export function rate(fps: number): string {
  return String(Math.round(fps * 100) / 100);
}

/** Rounds to a fader's step, without floating-point remainders (`0.15000000000000002`). */
export function toStep(value: number, step: number, origin: number): number {
  return Number((origin + Math.round((value - origin) / step) * step).toFixed(6));
}

/** A title in small letters, digits and hyphens; never empty. */
export function slug(title: string, fallback: string): string {
  const plain = title
    .normalize('NFKD')
    .replace(/\p{M}/gu, '')
    .toLowerCase()
    .replace(/[^a-z0-9]+/g, '-')
    .replace(/^-+|-+$/g, '')
    .slice(0, 40)
    .replace(/-+$/, '');
  return plain || fallback;
}

/** `slug` of a file's name without its ending. */
export function fileSlug(fileName: string, fallback: string): string {
  return slug(fileName.replace(/\.[a-z0-9]{1,5}$/i, ''), fallback);
}
