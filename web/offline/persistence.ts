/** The part of the browser's StorageManager that is needed; missing on insecure origins. */
export type Persistence = Pick<StorageManager, 'persist' | 'persisted'> | undefined;

/** Whether the browser has promised to keep what the page stores; null where it does not say. */
export async function isPersistent(storage: Persistence): Promise<boolean | null> {
  return (await storage?.persisted().catch(() => null)) ?? null;
}

/** Asks the browser for that promise, which some browsers ask the visitor about. */
export async function askPersistence(storage: Persistence): Promise<boolean | null> {
  return (await storage?.persist().catch(() => null)) ?? null;
}
