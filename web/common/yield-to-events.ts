/**
 * Lets waiting messages and timers in, then stops if one of them was a cancellation. Work that holds its thread pauses
 * here; a promise alone would not do, events come in tasks of their own.
 * @throws the signal's reason
 */
export async function yieldToEvents(signal?: AbortSignal): Promise<void> {
  await new Promise((resolve) => setTimeout(resolve));
  signal?.throwIfAborted();
}

/**
 * The same for work on the page itself, where timers are slowed down to one a second while the tab is in the
 * background, and messages are not.
 */
export async function yieldToPage(): Promise<void> {
  const { port1, port2 } = new MessageChannel();
  await new Promise((resolve) => {
    port1.onmessage = resolve;
    port2.postMessage(null);
  });
  port1.close();
}
