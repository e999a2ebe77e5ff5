import { describe, expect, it } from 'vitest';
import { AppError } from '../../../web/common/error';
import {
  explainedByVersion,
  loadPart,
  pagePartMissing,
  type PageSource,
} from '../../../web/common/page-part';

const page = (current: () => Promise<Response>): PageSource => ({
  document: { querySelector: () => ({ getAttribute: () => './assets/index-o1dHash-.js' }) as never },
  current,
});
const answers = (html: string, status = 200) => page(() => Promise.resolve(new Response(html, { status })));

describe('a part of the page that is missing', () => {
  it('is explained by a newer version where the server has a page with other scripts', async () => {
    const error = await explainedByVersion(
      pagePartMissing(),
      answers('<script type="module" src="./assets/index-newHash1.js"></script>'),
    );
    expect(error).toMatchObject({ code: 'newer-version', hint: expect.stringContaining('Reload') as string });
  });

  it.each([
    ['the same page', answers('<script type="module" src="./assets/index-o1dHash-.js"></script>')],
    ['an error', answers('Not found', 404)],
    [
      'the page of a network that asks to sign in',
      answers('<title>Sign in</title><script src="/in.js"></script>'),
    ],
    ['nothing', page(() => Promise.reject(new TypeError('Failed to fetch')))],
  ])('stays what it is where the server has %s', async (_, source) => {
    const missing = pagePartMissing();
    expect(await explainedByVersion(missing, source)).toBe(missing);
  });

  it('does not change failures that another version would not mend', async () => {
    const refused = new AppError('not-bvh', 'It is no BVH.', 'Export it again.');
    expect(await explainedByVersion(refused, answers('another page'))).toBe(refused);
  });

  it('is reported as one, with its cause', async () => {
    const cause = new TypeError('Failed to fetch dynamically imported module');
    await expect(loadPart(() => Promise.reject(cause))).rejects.toMatchObject({
      code: 'page-part-missing',
      cause,
    });
  });
});
