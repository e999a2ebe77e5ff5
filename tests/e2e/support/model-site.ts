import { existsSync } from 'node:fs';
import path from 'node:path';
import { test as base } from '@playwright/test';
import { servePage } from '../../../tools/bench/built-page.mjs';

export { expect } from '@playwright/test';

const project = path.resolve(import.meta.dirname, '../../..');
const salsa = path.join(project, 'web/public/models/salsa');
/** Whether the shipped model is there. */
export const shipped = existsSync(path.join(salsa, 'manifest.json'));
export const tinyFolder = path.join(project, 'tests/fixtures/tiny-model');

/** Playwright's test on a page that is nothing but the model client, built and served as the app is. */
export const test = base.extend<object, { modelSite: string }>({
  modelSite: [
    // eslint-disable-next-line no-empty-pattern -- Playwright reads the wanted fixtures from this pattern
    async ({}, use) => {
      const root = path.join(import.meta.dirname, 'model-page');
      const site = await servePage(root, { '/tiny/': tinyFolder, '/salsa/': salsa });
      await use(site.url);
      await site.close();
    },
    { scope: 'worker', timeout: 120_000 },
  ],
  baseURL: ({ modelSite }, use) => use(modelSite),
});
