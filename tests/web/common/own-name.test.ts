import { afterEach, expect, it, vi } from 'vitest';
import { ownName, ownStorage } from '../../../web/common/own-name';

const page = (baseURI: string) => ({ document: { baseURI } as Document });
const worker = (href: string) => ({ location: { href } as Location });

afterEach(() => {
  vi.unstubAllGlobals();
});

it('a page at the root of its site has the name itself, and so have its workers', () => {
  for (const scope of [
    page('https://dance.example/'),
    page('https://dance.example/index.html?model=models/mine/manifest.json'),
    worker('https://dance.example/assets/worker-AbC_dE-1.js'),
  ])
    expect(ownName('reactdance', scope)).toBe('reactdance');
});

it('pages in two folders have different names, and a page has the same one as its workers', () => {
  const names = ['a', 'b', 'a/b'].map((folder) => {
    const base = `https://dance.example/${folder}/`;
    const name = ownName('reactdance', page(base));
    expect(ownName('reactdance', page(`${base}index.html?study#top`))).toBe(name);
    expect(ownName('reactdance', worker(`${base}assets/worker-AbC_dE-1.js`))).toBe(name);
    return name;
  });
  expect(names).toEqual(['reactdance:%2Fa%2F', 'reactdance:%2Fb%2F', 'reactdance:%2Fa%2Fb%2F']);
});

it('entries of localStorage are the page’s own', () => {
  const all = new Map<string, string>();
  vi.stubGlobal('localStorage', {
    getItem: (key: string) => all.get(key) ?? null,
    setItem: (key: string, value: string) => all.set(key, value),
    removeItem: (key: string) => all.delete(key),
  });
  vi.stubGlobal('document', page('https://dance.example/').document);
  ownStorage().setItem('reactdance.preferences', 'root');
  expect([...all]).toEqual([['reactdance.preferences', 'root']]);
  vi.stubGlobal('document', page('https://dance.example/a/').document);
  expect(ownStorage().getItem('reactdance.preferences')).toBeNull();
  ownStorage().setItem('reactdance.preferences', 'a');
  expect(ownStorage().getItem('reactdance.preferences')).toBe('a');
  ownStorage().removeItem('reactdance.preferences');
  expect([...all]).toEqual([['reactdance.preferences', 'root']]);
});
