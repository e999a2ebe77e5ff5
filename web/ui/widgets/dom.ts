type Child = Node | string | null;

/** Attributes by their names; `true` is an empty attribute, `false` and `undefined` leave it out. */
export type Attributes = Readonly<Record<string, string | number | boolean | undefined>>;

interface Properties {
  readonly class?: string;
  readonly text?: string;
  readonly attributes?: Attributes;
  readonly on?: { readonly [K in keyof HTMLElementEventMap]?: (event: HTMLElementEventMap[K]) => void };
}

/** Of what is no word of a language, such as names, keys and running numbers: browsers that translate pages leave it. */
export const UNTRANSLATED = { translate: 'no' } as const;

/** Makes an element. No markup strings anywhere, so nothing a file name contains can become markup. */
export function el<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  properties: Properties = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  if (properties.class) element.className = properties.class;
  if (properties.text !== undefined) element.textContent = properties.text;
  for (const [name, value] of Object.entries(properties.attributes ?? {})) setAttribute(element, name, value);
  for (const [type, listener] of Object.entries(properties.on ?? {}))
    element.addEventListener(type, listener as EventListener);
  element.append(...children.filter((child) => child !== null));
  return element;
}

/** Sets, or with `false` and `undefined` removes, an attribute. */
export function setAttribute(
  element: Element,
  name: string,
  value: string | number | boolean | undefined,
): void {
  if (value === undefined || value === false) element.removeAttribute(name);
  else element.setAttribute(name, value === true ? '' : String(value));
}

/** Sets the text only when it differs, so that a running clock does not cause layout with every frame. */
export function setText(element: Element, text: string): void {
  if (element.textContent !== text) element.textContent = text;
}

/** Sets a CSS custom property, the one way in which numbers reach the style sheets. */
export function setVariable(element: HTMLElement, name: `--${string}`, value: number): void {
  element.style.setProperty(name, String(Math.round(value * 1e5) / 1e5));
}

/**
 * Hides or shows an element. Where the focus is inside when it goes, `next` gets it: browsers would drop it, and whoever
 * uses keys or a screen reader would be at the top of the page.
 */
export function setHidden(element: HTMLElement, hidden: boolean, next: HTMLElement | null): void {
  const hasFocus = hidden && element.contains(document.activeElement);
  element.hidden = hidden;
  if (hasFocus) next?.focus();
}

/**
 * Remembers what has the focus, for a panel that opens.
 * @returns gives the focus back when the panel closes, if it is inside; to be called before the panel is hidden
 */
export function rememberFocus(): (panel: HTMLElement) => void {
  const before = document.activeElement;
  return (panel) => {
    if (!before || !panel.contains(document.activeElement)) return;
    // What has been made anew meanwhile has the same id.
    const there = before.isConnected ? before : document.getElementById(before.id);
    if (there instanceof HTMLElement) there.focus();
  };
}

/**
 * Remembers what has the focus each time a panel opens, and gives it back each time it closes.
 * @returns to be called when the panel opens, and before it is hidden
 */
export function returnFocusOf(panel: HTMLElement): (open: boolean) => void {
  let giveBack = rememberFocus();
  return (open) => {
    if (open) giveBack = rememberFocus();
    else giveBack(panel);
  };
}

/**
 * Shows or hides a panel, and says so on the button that opens it. The focus goes to the panel's `first`, and back to the
 * button when it is inside as the panel closes.
 */
export function setOpen(
  panel: HTMLElement,
  opener: HTMLElement,
  open: boolean,
  first: () => HTMLElement | null | undefined,
): void {
  const focusInside = panel.contains(document.activeElement);
  panel.hidden = !open;
  opener.setAttribute('aria-expanded', String(open));
  if (open) first()?.focus();
  else if (focusInside) opener.focus();
}

/** Combines several disposers into one. */
export function combineDisposers(...disposers: (() => void)[]): () => void {
  return () => {
    for (const dispose of disposers) dispose();
  };
}

/** Calls back when the pointer goes down outside all of these elements. */
export function onPressOutside(elements: readonly Element[], listener: () => void): void {
  window.addEventListener('pointerdown', ({ target }) => {
    if (target instanceof Node && !elements.some((element) => element.contains(target))) listener();
  });
}
