/** What the page's address can set. */
interface Parameters {
  /** Absolute address of the model's manifest; always of this page's own origin. */
  readonly manifestUrl: string;
  readonly backend: 'auto' | 'webgpu' | 'wasm';
}

/** The model that ships with the page, relative to it. */
const SHIPPED_MODEL = 'models/salsa/manifest.json';

/**
 * Reads `?model=<path to a manifest.json>` and `?backend=webgpu|wasm`. A model of another origin is ignored: the
 * page connects to no other origin.
 * @param search the query, with its question mark
 * @param base the page's address
 */
export function readParameters(search: string, base: string): Parameters {
  const query = new URLSearchParams(search);
  const shipped = new URL(SHIPPED_MODEL, base);
  const wanted = query.get('model');
  const asked = wanted !== null && URL.canParse(wanted, base) ? new URL(wanted, base) : shipped;
  const backend = query.get('backend');
  return {
    manifestUrl: (asked.origin === shipped.origin ? asked : shipped).href,
    backend: backend === 'webgpu' || backend === 'wasm' ? backend : 'auto',
  };
}
