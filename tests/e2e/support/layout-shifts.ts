import type { Locator, Page } from '@playwright/test';

/** A layout shift as the browser reports it (Layout Instability API). */
export interface Shift {
  /** Share of the window that moved times how far, 0 to 1. */
  readonly value: number;
  /** Whether a key or click came within the half second before. */
  readonly afterInput: boolean;
  /** What moved, from where to where. */
  readonly what: readonly string[];
}

/** Selector of all controls. */
const CONTROLS = 'button, input, select, [role="slider"], [role="radio"], [role="switch"]';

/** Records layout shifts of a page from its first navigation on; to be created before the page is opened. */
export class LayoutMonitor {
  private constructor(private readonly page: Page) {}

  static async begin(page: Page): Promise<LayoutMonitor> {
    await page.addInitScript(watch, CONTROLS);
    return new LayoutMonitor(page);
  }

  /** The layout shifts since the last call, after two more frames. */
  async shifts(): Promise<Shift[]> {
    return this.page.evaluate<Shift[]>('window.layoutMonitor.shifts()');
  }

  /** Stores the position of every control. */
  async mark(): Promise<void> {
    await this.page.evaluate('window.layoutMonitor.mark()');
  }

  /** Visible controls that have moved since `mark`; scrolling does not count. */
  async moved(): Promise<string[]> {
    return this.page.evaluate<string[]>('window.layoutMonitor.moved(null)');
  }

  /** `moved` without the controls after this one in its panel, which it pushes down when it unfolds. */
  async movedElsewhere(unfolder: Locator): Promise<string[]> {
    const button = await unfolder.elementHandle();
    return this.page.evaluate((unfolding) => {
      const { moved } = Reflect.get(globalThis, 'layoutMonitor') as { moved: (from: unknown) => string[] };
      return moved(unfolding);
    }, button);
  }
}

/** Runs in the page. */
function watch(controls: string): void {
  interface Entry extends PerformanceEntry {
    readonly value: number;
    readonly hadRecentInput: boolean;
    readonly sources: readonly { node: Node | null; previousRect: DOMRect; currentRect: DOMRect }[];
  }
  const name = (node: Node | null): string => {
    const element = node instanceof Element ? node : node?.parentElement;
    if (!element) return 'something gone';
    const words = element.getAttribute('aria-label') ?? element.textContent.trim().slice(0, 24);
    return `${element.localName}.${element.getAttribute('class') ?? ''} "${words}"`;
  };
  const place = ({ x, y, width, height }: DOMRect): string => [x, y, width, height].map(Math.round).join(' ');
  const seen: unknown[] = [];
  const note = (entries: PerformanceEntryList): void => {
    for (const entry of entries as Entry[])
      seen.push({
        value: entry.value,
        afterInput: entry.hadRecentInput,
        what: entry.sources.map(
          ({ node, previousRect, currentRect }) =>
            `${name(node)}: ${place(previousRect)} -> ${place(currentRect)}`,
        ),
      });
  };
  const observer = new PerformanceObserver((list) => {
    note(list.getEntries());
  });
  observer.observe({ type: 'layout-shift', buffered: true });

  const picture = (): Promise<number> => new Promise((resolve) => requestAnimationFrame(resolve));
  /** Corner of a control, as if nothing around it had been scrolled. */
  const corner = (element: Element): readonly [number, number] => {
    let { x, y } = element.getBoundingClientRect();
    for (let around = element.parentElement; around; around = around.parentElement) {
      x += around.scrollLeft;
      y += around.scrollTop;
    }
    return [x, y];
  };
  const visible = (): Element[] =>
    [...document.querySelectorAll(controls)].filter((element) =>
      element.checkVisibility({ visibilityProperty: true }),
    );
  const pushedDown = (element: Element, unfolder: Element | null): boolean =>
    unfolder?.closest('aside')?.contains(element) === true &&
    (unfolder.compareDocumentPosition(element) & Node.DOCUMENT_POSITION_FOLLOWING) !== 0;
  let marked = new Map<Element, readonly [number, number]>();
  Reflect.set(globalThis, 'layoutMonitor', {
    async shifts() {
      await picture();
      await picture();
      note(observer.takeRecords());
      return seen.splice(0);
    },
    mark() {
      marked = new Map(visible().map((element) => [element, corner(element)]));
    },
    moved: (unfolder: Element | null) =>
      visible().flatMap((element) => {
        const before = marked.get(element);
        if (!before || pushedDown(element, unfolder)) return [];
        const [dx, dy] = corner(element).map((at, i) => Math.round(at - before[i]!));
        return dx || dy ? [`${name(element)} by ${dx}, ${dy}`] : [];
      }),
  });
}
