import { expect, test, vi } from 'vitest';
import { planVideo } from '../../../web/export/client';

// In a file of its own: the library keeps what it was told about a browser's encoders, and so does the page.
test('without encoders of sound the one of the page is loaded, at the next call when it could not be', async () => {
  const size = { width: 1920, height: 1080 };
  const encoding = (codecs: RegExp) => ({
    isConfigSupported: (config: { codec: string }) =>
      Promise.resolve({ supported: codecs.test(config.codec), config }),
  });
  vi.stubGlobal('VideoEncoder', encoding(/^(avc1|vp8)/));
  vi.stubGlobal('AudioEncoder', encoding(/^$/));
  vi.doMock('@mediabunny/aac-encoder', () => {
    throw new Error('The page is offline.');
  });
  expect(await planVideo(size, true)).toBeNull();
  vi.doUnmock('@mediabunny/aac-encoder');
  expect(await planVideo(size, true)).toMatchObject({ container: 'mp4', video: 'avc', audio: 'aac' });
});
