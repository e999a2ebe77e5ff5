import { fileURLToPath } from 'node:url';
import { defineConfig, type Plugin } from 'vite';
import { listedFile } from './tools/listed-file.mjs';
import { offlineShell } from './tools/offline-shell.mjs';
import { precompress } from './tools/precompress.mjs';
import { contentSecurityPolicy, isolationHeaders, securityHeaders } from './tools/security-headers.mjs';
import { licences } from './tools/vite/licences.mjs';

const dist = fileURLToPath(new URL('dist', import.meta.url));

/** The built page carries its own policy. In development Vite's injected <style> elements would break on it. */
const policyInPage: Plugin = {
  name: 'content-security-policy',
  apply: 'build',
  transformIndexHtml: () => [
    {
      tag: 'meta',
      attrs: { 'http-equiv': 'Content-Security-Policy', content: contentSecurityPolicy },
      injectTo: 'head-prepend',
    },
  ],
};

/** The typeface comes with the first files instead of after them, so that no word changes its width later. */
const fontFirst: Plugin = {
  name: 'font-first',
  apply: 'build',
  transformIndexHtml: {
    order: 'post',
    handler: (_, { bundle = {} }) =>
      Object.keys(bundle)
        .filter((file) => file.endsWith('.woff2'))
        .map((file) => ({
          tag: 'link',
          attrs: { rel: 'preload', href: `./${file}`, as: 'font', type: 'font/woff2', crossorigin: true },
          injectTo: 'head',
        })),
  },
};

const brotli: Plugin = {
  name: 'brotli',
  apply: 'build',
  enforce: 'post',
  closeBundle: () => precompress(dist),
};

const { page: licencesOfPage, worker: licencesOfWorker } = licences();

export default defineConfig({
  root: 'web',
  base: './',
  plugins: [listedFile(), policyInPage, fontFirst, licencesOfPage, offlineShell(dist), brotli],
  // onnxruntime-web finds its wasm by import.meta.url, which pre-bundling would move.
  optimizeDeps: { exclude: ['onnxruntime-web'] },
  worker: { format: 'es', plugins: () => [listedFile(), licencesOfWorker()] },
  server: { headers: isolationHeaders },
  preview: { headers: securityHeaders },
  build: {
    outDir: dist,
    emptyOutDir: true,
    target: 'es2023',
    // The time that brotli takes is no news.
    rolldownOptions: { checks: { pluginTimings: false } },
    // data: addresses would need a hole in the policy.
    assetsInlineLimit: 0,
    // three and onnxruntime are this large; both are needed before anything is seen.
    chunkSizeWarningLimit: 1500,
  },
});
