import { defineConfig } from 'vitest/config';
import { manifestEntry } from './tools/vite/manifest-entry.mjs';

export default defineConfig({
  plugins: [manifestEntry()],
  test: {
    include: ['tests/web/**/*.test.ts'],
    environment: 'node',
    // Two cores, and some tests run real graphs that use both.
    maxWorkers: 2,
    testTimeout: 30_000,
    // The plugin's modules, which lie among the packages.
    server: { deps: { inline: [/\?manifest-entry$/] } },
  },
});
