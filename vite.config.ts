import path from 'node:path';
import pxToRem from 'postcss-pxtorem';
import { defineConfig, type Plugin } from 'vite';
import { contentSecurityPolicy, isolationHeaders, securityHeaders } from './tools/security-headers.mjs';
import { licences } from './tools/vite/licences.mjs';
import { manifestEntry } from './tools/vite/manifest-entry.mjs';
import { precompress } from './tools/vite/precompress.mjs';
import { serviceWorker, workerChunkName } from './tools/vite/service-worker.mjs';

/** A <meta> element with the Content-Security-Policy. In development Vite's injected <style> elements would break on it. */
const policyElement: Plugin = {
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

/** Preloads the font with the first files, so that no word changes its width later. */
const preloadFont: Plugin = {
  name: 'preload-font',
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

/** Preloads the app, which start.ts imports, with the first files. */
const preloadApp: Plugin = {
  name: 'preload-app',
  apply: 'build',
  transformIndexHtml: {
    order: 'post',
    handler: (_, { bundle = {} }) => {
      const chunks = Object.values(bundle).filter((file) => file.type === 'chunk');
      const app = chunks.find(({ facadeModuleId }) => facadeModuleId?.endsWith('/web/main.ts'));
      return [app?.fileName, ...(app?.imports ?? [])].map((file) => ({
        tag: 'link',
        attrs: { rel: 'modulepreload', href: `./${file}`, crossorigin: true },
        injectTo: 'head',
      }));
    },
  },
};

/** Names the picture that messengers show beside a link; they need its whole address, of the site in SITE_URL. */
const linkPicture: Plugin = {
  name: 'link-picture',
  apply: 'build',
  transformIndexHtml: () => {
    const site = process.env['SITE_URL'];
    if (!site) return [];
    const content = new URL('site/link.jpg', site).href;
    return [{ tag: 'meta', attrs: { property: 'og:image', content }, injectTo: 'head' }];
  },
};

/** Brotli copies of the built files. */
const brotli: Plugin = {
  name: 'brotli',
  apply: 'build',
  enforce: 'post',
  closeBundle() {
    const { root, build } = this.environment.config;
    return precompress(path.resolve(root, build.outDir));
  },
};

/** It would warn of the time that plugins take, such as brotli, on a slow machine in each worker too. */
const checks = { pluginTimings: false };

const { page: licencesOfPage, worker: licencesOfWorker } = licences();

export default defineConfig({
  root: 'web',
  base: './',
  plugins: [
    manifestEntry(),
    policyElement,
    preloadFont,
    preloadApp,
    linkPicture,
    licencesOfPage,
    serviceWorker,
    brotli,
  ],
  // onnxruntime-web finds its wasm by import.meta.url, which pre-bundling would move.
  optimizeDeps: { exclude: ['onnxruntime-web'] },
  worker: {
    format: 'es',
    plugins: () => [manifestEntry(), licencesOfWorker()],
    rolldownOptions: { checks, output: { chunkFileNames: workerChunkName } },
  },
  // Whoever has set a larger text in the browser gets all of the page larger, as if it were zoomed. Hairlines stay.
  css: { postcss: { plugins: [pxToRem({ propList: ['*'], mediaQuery: true, minPixelValue: 2 })] } },
  server: { headers: isolationHeaders },
  preview: { headers: securityHeaders },
  build: {
    outDir: '../dist',
    emptyOutDir: true,
    target: 'es2023',
    rolldownOptions: {
      checks,
      output: {
        // GitHub Pages leaves out files whose names begin with "_", as the bundler's own do.
        chunkFileNames: ({ name }) => `assets/${name.replace(/^_+/, '')}-[hash].js`,
      },
    },
    // data: addresses would need a hole in the policy.
    assetsInlineLimit: 0,
    // three and onnxruntime are this large; both are needed before anything is seen.
    chunkSizeWarningLimit: 1500,
  },
});
