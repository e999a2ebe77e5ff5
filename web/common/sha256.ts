/** Lower-case hexadecimal digits, two for each byte. */
export function hex(bytes: Uint8Array): string {
  return Array.from(bytes, (byte) => byte.toString(16).padStart(2, '0')).join('');
}

/** Hexadecimal SHA-256; undefined on an insecure origin, where the browser does not offer it. */
export async function sha256(bytes: BufferSource): Promise<string | undefined> {
  const subtle = (globalThis.crypto as Partial<Crypto> | undefined)?.subtle;
  return subtle && hex(new Uint8Array(await subtle.digest('SHA-256', bytes)));
}
