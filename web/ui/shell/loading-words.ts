import { bytesOf } from '../store/format';
import type { ModelState } from '../store/state';

type Loading = Extract<ModelState, { readonly phase: 'loading' }>;

/** What is coming and how much of it is here: `Runtime`, `12.0 of 14.2 MB, model from this device`. */
export function loadingWords({ label, received, total, parts = [] }: Loading): {
  readonly title: string;
  readonly detail: string;
} {
  if (parts.length === 0) return { title: label, detail: total > 0 ? bytesOf(received, total) : '' };
  const coming = parts.filter(({ kept, total }) => kept < total);
  const here = parts.filter(({ kept, total }) => kept >= total);
  if (coming.length === 0) return { title: capital(named(here)), detail: 'from this device' };
  const loaded = coming.reduce((sum, part) => sum + part.loaded, 0);
  const whole = coming.reduce((sum, part) => sum + part.total, 0);
  return {
    title: capital(named(coming)),
    detail: bytesOf(loaded, whole) + (here.length > 0 ? `, ${named(here)} from this device` : ''),
  };
}

function named(parts: readonly { readonly name: string }[]): string {
  return parts.map(({ name }) => name).join(' and ');
}

function capital(words: string): string {
  return words.charAt(0).toUpperCase() + words.slice(1);
}
