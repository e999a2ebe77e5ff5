/** Starts what the address asks for, the app, or with `?study` the blind test, where the browser can run it. */

/** Of all that the page needs, browsers had these two last: Chrome and Edge 116, Firefox 125, Safari 17.4. */
const isRecent = 'any' in AbortSignal && 'togglePopover' in HTMLElement.prototype;

/** Why this browser can't run the page, and what to do; null where it can. */
function obstacle(): string | null {
  if (!isRecent)
    return (
      'This browser is too old for this page, which needs Chrome or Edge 116, Firefox 125, Safari 17.4 (iOS 17.4) ' +
      'or anything later. Update the browser, or open the page in another one.'
    );
  if (!('WebAssembly' in globalThis))
    return (
      'WebAssembly, in which this page computes, is switched off in this browser. Lockdown Mode of an iPhone, iPad or ' +
      'Mac does that: switch it off for this page in the page menu of Safari, then reload.'
    );
  return null;
}

/** Why the page did not start, and what to do. */
function reason(error: unknown): string {
  console.error(error);
  return origin === 'null'
    ? 'The frame that shows this page is sandboxed, so the page cannot run in it. Open it in a tab of its own.'
    : 'A part of this page could not be loaded. Check the connection, then reload the page.';
}

/** Puts a sentence in the place of the page. */
function showInstead(sentence: string): void {
  const paragraph = document.createElement('p');
  paragraph.className = 'instead';
  paragraph.setAttribute('role', 'alert');
  paragraph.textContent = sentence;
  document.body.replaceChildren(paragraph);
}

async function start(): Promise<void> {
  const found = obstacle();
  if (found) {
    showInstead(found);
    return;
  }
  try {
    await (new URLSearchParams(location.search).has('study') ? import('./study') : import('./main'));
    document.querySelector('.unstarted')?.remove();
  } catch (error) {
    showInstead(reason(error));
  }
}

void start();
