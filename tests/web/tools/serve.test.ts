import { mkdirSync, mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { request, type IncomingHttpHeaders, type Server } from 'node:http';
import { tmpdir } from 'node:os';
import path from 'node:path';
import { brotliDecompressSync } from 'node:zlib';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { createSite, listen } from '../../../tools/serve.mjs';
import { precompress } from '../../../tools/vite/precompress.mjs';

const script = 'export const steps = [1, 2, 3, 5, 6, 7];\n'.repeat(50);
const song = Buffer.from(Array.from({ length: 1000 }, (_, index) => index % 251));

interface Answer {
  readonly status: number;
  readonly headers: IncomingHttpHeaders;
  readonly body: Buffer;
}

let folder: string;
let site: Server;
let address: string;

beforeAll(async () => {
  folder = mkdtempSync(path.join(tmpdir(), 'reactdance-site-'));
  const root = path.join(folder, 'dist');
  const fixtures = path.join(folder, 'fixtures');
  mkdirSync(path.join(root, 'assets'), { recursive: true });
  mkdirSync(fixtures);
  writeFileSync(path.join(folder, 'secret.txt'), 'not for visitors');
  writeFileSync(path.join(folder, 'dist-of-another.txt'), 'not for visitors either');
  writeFileSync(path.join(root, 'index.html'), '<!doctype html><title>Page</title>');
  writeFileSync(path.join(root, 'assets', 'main-1a2b.js'), script);
  writeFileSync(path.join(root, 'song.wav'), song);
  for (const name of ['step.onnx', 'sample.webm', 'dance.glb']) writeFileSync(path.join(root, name), song);
  writeFileSync(path.join(fixtures, 'manifest.json'), '{}');
  await precompress(root);
  site = createSite({ root, mounts: { '/models/tiny/': fixtures } });
  address = await listen(site, { port: 0 });
});

afterAll(() => {
  site.close();
  site.closeAllConnections();
  rmSync(folder, { recursive: true });
});

/** Unlike fetch, sends the path as it is: `..` too. */
function get(target: string, headers: Record<string, string> = {}, method = 'GET'): Promise<Answer> {
  return new Promise((resolve, reject) => {
    const { hostname, port } = new URL(address);
    const sent = request({ hostname, port, path: target, headers, method }, (response) => {
      const chunks: Buffer[] = [];
      response.on('data', (chunk: Buffer) => chunks.push(chunk));
      response.on('end', () => {
        resolve({ status: response.statusCode ?? 0, headers: response.headers, body: Buffer.concat(chunks) });
      });
    });
    sent.on('error', reject);
    sent.end();
  });
}

describe('the server of the built app', () => {
  it('isolates the page and lets it speak to its own origin only', async () => {
    const { status, headers, body } = await get('/');
    expect(status).toBe(200);
    expect(String(body)).toContain('<title>Page</title>');
    expect(headers['content-type']).toBe('text/html; charset=utf-8');
    expect(headers['cross-origin-opener-policy']).toBe('same-origin');
    expect(headers['cross-origin-embedder-policy']).toBe('require-corp');
    const policy = headers['content-security-policy'] ?? '';
    expect(policy).toContain("default-src 'self'");
    expect(policy).toContain("'wasm-unsafe-eval'");
    expect(policy).not.toMatch(/https?:|\*|'unsafe-inline'|'unsafe-eval'|data:/);
  });

  it('sends scripts compressed to those who take it, whole to the others', async () => {
    const small = await get('/assets/main-1a2b.js', { 'Accept-Encoding': 'gzip, deflate, br' });
    expect(small.headers['content-encoding']).toBe('br');
    expect(small.headers['content-type']).toBe('text/javascript; charset=utf-8');
    expect(small.headers['cache-control']).toContain('immutable');
    expect(small.body.length).toBeLessThan(script.length / 10);
    expect(String(brotliDecompressSync(small.body))).toBe(script);
    for (const refusal of ['gzip', 'br;q=0', 'brotli']) {
      const whole = await get('/assets/main-1a2b.js', { 'Accept-Encoding': refusal });
      expect(whole.headers['content-encoding']).toBeUndefined();
      expect(String(whole.body)).toBe(script);
    }
  });

  it('answers 404, never the page, for what is missing', async () => {
    for (const target of ['/models/salsa/step.onnx', '/nowhere', '/assets/', '/assets', '/%', '/%00']) {
      const { status, headers } = await get(target);
      expect([target, status, headers['content-type']]).toEqual([target, 404, 'text/plain; charset=utf-8']);
    }
    expect((await get('/', {}, 'POST')).status).toBe(405);
  });

  it('keeps everything outside its folders to itself', async () => {
    const ways = ['/../secret.txt', '/%2e%2e/secret.txt', '/..%2fsecret.txt', '/assets/../../secret.txt'];
    ways.push(
      '//secret.txt',
      '/../dist-of-another.txt',
      '/models/tiny/../secret.txt',
      '/models/tiny/%2e%2e/secret.txt',
    );
    for (const target of ways) expect([target, (await get(target)).status]).toEqual([target, 404]);
  });

  it('sends the asked part of a song', async () => {
    const cases: [string, number, number][] = [
      ['bytes=0-99', 0, 99],
      ['bytes=900-', 900, 999],
      ['bytes=-10', 990, 999],
      ['bytes=990-5000', 990, 999],
    ];
    for (const [header, start, end] of cases) {
      const part = await get('/song.wav', { Range: header });
      expect(part.status).toBe(206);
      expect(part.headers['content-range']).toBe(`bytes ${start}-${end}/1000`);
      expect(part.body).toEqual(song.subarray(start, end + 1));
    }
    const outside = await get('/song.wav', { Range: 'bytes=1000-' });
    expect([outside.status, outside.headers['content-range']]).toEqual([416, 'bytes */1000']);
    expect((await get('/song.wav', { Range: 'bytes=0-1,5-9' })).body).toEqual(song);
    expect((await get('/song.wav', {}, 'HEAD')).headers['content-length']).toBe('1000');
  });

  it('says what videos, scenes and graphs are, also of a part', async () => {
    for (const [name, type] of [
      ['sample.webm', 'video/webm'],
      ['dance.glb', 'model/gltf-binary'],
      ['step.onnx', 'application/octet-stream'],
    ] as const) {
      const whole = await get(`/${name}`);
      const part = await get(`/${name}`, { Range: 'bytes=100-199' });
      for (const { headers } of [whole, part]) expect([name, headers['content-type']]).toEqual([name, type]);
      expect([whole.status, whole.headers['accept-ranges'], part.status]).toEqual([200, 'bytes', 206]);
      expect(part.body).toEqual(song.subarray(100, 200));
    }
  });

  it('does not send again what the browser has', async () => {
    const tag = (await get('/step.onnx')).headers.etag ?? '';
    const again = await get('/step.onnx', { 'If-None-Match': tag });
    expect([again.status, again.body.length]).toEqual([304, 0]);
  });

  it('serves mounted folders below their address', async () => {
    expect(String((await get('/models/tiny/manifest.json?v=1')).body)).toBe('{}');
  });

  it('takes the next port when one is busy', async () => {
    const second = createSite({ root: folder });
    const port = Number(new URL(address).port);
    const moved = await listen(second, { port });
    second.close();
    expect(Number(new URL(moved).port)).toBeGreaterThan(port);
  });
});
