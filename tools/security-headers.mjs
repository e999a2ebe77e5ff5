/**
 * The response headers of the app, in one place for the dev server, the preview, our own server and the
 * policy that the build writes into index.html (for hosts where headers can't be set).
 */

/**
 * Everything comes from the page's own origin. Also allowed is what the app needs: WebAssembly compilation for
 * onnxruntime, blob: workers for its threads, blob: media for the user's own song.
 */
export const contentSecurityPolicy = [
  "default-src 'self'",
  "script-src 'self' 'wasm-unsafe-eval'",
  "worker-src 'self' blob:",
  "media-src 'self' blob:",
  "object-src 'none'",
  "base-uri 'none'",
  "form-action 'none'",
].join('; ');

/** Cross-origin isolation: without it the browser refuses SharedArrayBuffer and wasm runs on one thread. */
export const isolationHeaders = {
  'Cross-Origin-Opener-Policy': 'same-origin',
  'Cross-Origin-Embedder-Policy': 'require-corp',
};

/** All headers of a built app. `frame-ancestors` counts in a header only, browsers ignore it in a meta tag. */
export const securityHeaders = {
  ...isolationHeaders,
  'Content-Security-Policy': `${contentSecurityPolicy}; frame-ancestors 'none'`,
  'Cross-Origin-Resource-Policy': 'same-origin',
  'Referrer-Policy': 'no-referrer',
  'X-Content-Type-Options': 'nosniff',
};
