/**
 * Let waiting messages in, then stop if one of them was a cancellation. A graph run holds its thread and cannot be
 * aborted, so work pauses here between runs; a promise alone would not do, messages come in tasks of their own.
 * @throws the signal's reason
 */
export async function nextTurn(signal?: AbortSignal): Promise<void> {
  await new Promise((resolve) => setTimeout(resolve));
  signal?.throwIfAborted();
}
