import { expect, it } from 'vitest';
import { fileStore, responseCache } from '../../../../web/model/load/cache';
import { memoryCaches } from '../../support/memory-caches';

const bytes = (text: string): Uint8Array<ArrayBuffer> => new TextEncoder().encode(text);

it('what a model no longer needs is deleted, and nothing of another model or that is no file of a model', async () => {
  const location = new URL('https://dance.example/page/');
  const scope = { caches: memoryCaches().caches, location } as unknown as typeof globalThis;
  const [own, below, other] = ['a', 'a/b', 'b'].map((owner) => fileStore(scope, 'model', owner)!) as [
    NonNullable<ReturnType<typeof fileStore>>,
    NonNullable<ReturnType<typeof fileStore>>,
    NonNullable<ReturnType<typeof fileStore>>,
  ];
  const manifests = responseCache(scope)!;
  const manifest = 'https://dance.example/page/models/a/manifest.json';
  for (const key of ['old', 'new']) await own.put(key, bytes(`own ${key}`));
  for (const store of [below, other]) await store.put('old', bytes('theirs'));
  await manifests.put(manifest, bytes('{}'));
  await own.keepOnly(['new']);
  expect(await own.get('old')).toBeUndefined();
  expect(await own.get('new')).toEqual(bytes('own new'));
  expect(await below.get('old')).toEqual(bytes('theirs'));
  expect(await other.get('old')).toEqual(bytes('theirs'));
  expect(await manifests.get(manifest)).toEqual(bytes('{}'));
});

it('without storage there is no store', () => {
  const blocked = {
    get caches(): CacheStorage {
      throw new DOMException('Blocked.', 'SecurityError');
    },
  } as unknown as typeof globalThis;
  expect(fileStore(blocked, 'model', 'a')).toBeUndefined();
  expect(responseCache(blocked)).toBeUndefined();
});
