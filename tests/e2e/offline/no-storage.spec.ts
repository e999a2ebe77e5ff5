/** The page where the browser lets it keep nothing. */
import { bvh } from '../support/files';
import { App } from '../support/app-page';
import { expect, test } from '../support/fixtures';

test('where all that sites keep is forbidden, as in Firefox, the page works and says that it keeps nothing', async ({
  page,
}) => {
  await page.addInitScript(() => {
    const forbidden = (): never => {
      throw new DOMException('The operation is insecure.', 'SecurityError');
    };
    for (const name of ['localStorage', 'indexedDB', 'caches'])
      Object.defineProperty(window, name, { get: forbidden });
    Object.assign(window, { BroadcastChannel: forbidden });
    LockManager.prototype.request = () => Promise.reject(new DOMException('Insecure.', 'SecurityError'));
  });
  const app = new App(page);
  await app.openWithoutPicture();
  await app.chooseLeader(bvh({ frames: 60, name: 'valid.bvh' }));
  await app.reaction('valid.bvh');
  await app.until(({ autosave }) => autosave === 'refused');
});

test('in a sandboxed frame, in which no browser lets it run, the page says so', async ({ page, site }) => {
  // The tests' server forbids frames, as docs/hosting.md advises.
  await page.route('**/*', async (route) => {
    const response = await route.fetch();
    await route.fulfill({
      response,
      headers: { 'content-type': response.headers()['content-type']!, 'access-control-allow-origin': '*' },
    });
  });
  await page.route('**/frame', (route) =>
    route.fulfill({
      contentType: 'text/html',
      body: `<iframe sandbox="allow-scripts" src="${site}"></iframe>`,
    }),
  );
  await page.goto('/frame');
  await expect(page.frameLocator('iframe').getByText('Open it in a tab of its own.')).toBeVisible();
});
