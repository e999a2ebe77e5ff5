import { defineConfig } from 'vitest/config';

export default defineConfig({
  test: {
    include: ['tests/web/**/*.test.ts'],
    environment: 'node',
    // Two cores, and some tests run real graphs that use both.
    maxWorkers: 2,
    testTimeout: 30_000,
  },
});
