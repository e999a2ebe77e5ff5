/**
 * Serves the built app as a plain static site: `npm run serve`, and the server of the browser tests.
 * Only built-in modules, so that nothing has to be installed to look at a build.
 */
import { createReadStream } from 'node:fs';
import { stat } from 'node:fs/promises';
import { createServer } from 'node:http';
import path from 'node:path';
import { pipeline } from 'node:stream/promises';
import { fileURLToPath } from 'node:url';
import { isProgram } from './run.mjs';
import { securityHeaders } from './security-headers.mjs';

/** Tries this many ports after the wanted one. */
const PORTS_TO_TRY = 20;

/** @type {Record<string, string>} */
const types = {
  '.bvh': 'text/plain; charset=utf-8',
  '.css': 'text/css; charset=utf-8',
  '.flac': 'audio/flac',
  '.glb': 'model/gltf-binary',
  '.html': 'text/html; charset=utf-8',
  '.ico': 'image/x-icon',
  '.js': 'text/javascript; charset=utf-8',
  '.json': 'application/json; charset=utf-8',
  '.m4a': 'audio/mp4',
  '.md': 'text/markdown; charset=utf-8',
  '.mjs': 'text/javascript; charset=utf-8',
  '.mp3': 'audio/mpeg',
  '.ogg': 'audio/ogg',
  // No type of its own is registered.
  '.onnx': 'application/octet-stream',
  '.opus': 'audio/ogg',
  '.png': 'image/png',
  '.svg': 'image/svg+xml',
  '.txt': 'text/plain; charset=utf-8',
  '.wasm': 'application/wasm',
  '.wav': 'audio/wav',
  '.webm': 'video/webm',
  '.webp': 'image/webp',
  '.woff2': 'font/woff2',
};

/**
 * A server of the folder `root`. A missing file is answered with 404 and plain text, never with the page:
 * a model graph served as HTML would only fail later, inside the runtime.
 *
 * @param {{ root: string, mounts?: Record<string, string> }} options `mounts` serves further folders, by the
 *   beginning of the address ('/models/tiny/' → a folder); tests add their fixtures with it.
 */
export function createSite({ root, mounts = {} }) {
  const folders = Object.entries({ ...mounts, '/': root }).sort(([a], [b]) => b.length - a.length);
  return createServer((request, response) => {
    answer(request, response, folders).catch((/** @type {unknown} */ error) => {
      // After the headers the connection can only be closed: the browser has left in the middle of a file.
      if (!response.headersSent)
        refuse(response, 500, error instanceof Error ? error.message : String(error));
      response.destroy();
    });
  });
}

/**
 * @param {import('node:http').IncomingMessage} request
 * @param {import('node:http').ServerResponse} response
 * @param {[string, string][]} folders address beginnings with their folders, longest first
 */
async function answer(request, response, folders) {
  if (request.method !== 'GET' && request.method !== 'HEAD') {
    response.setHeader('Allow', 'GET, HEAD');
    return refuse(response, 405, 'Only GET and HEAD');
  }
  const file = locate(request.url ?? '/', folders);
  const info = file === undefined ? undefined : await stat(file).catch(() => undefined);
  if (file === undefined || !info?.isFile()) return refuse(response, 404, 'Not found');

  const tag = `"${info.size.toString(36)}-${Math.floor(info.mtimeMs).toString(36)}"`;
  const headers = {
    ...securityHeaders,
    'Content-Type': types[path.extname(file)] ?? 'application/octet-stream',
    // Names below assets/ carry a hash of their content.
    'Cache-Control': /[\\/]assets[\\/]/.test(file) ? 'public, max-age=31536000, immutable' : 'no-cache',
    ETag: tag,
    Vary: 'Accept-Encoding',
  };
  if (request.headers['if-none-match'] === tag) return void response.writeHead(304, headers).end();

  const wanted = range(request.headers.range, info.size);
  if (wanted === 'outside') {
    response.writeHead(416, { ...securityHeaders, 'Content-Range': `bytes */${info.size}` }).end();
    return;
  }
  if (wanted !== 'everything') {
    const length = wanted.end - wanted.start + 1;
    const part = {
      'Content-Range': `bytes ${wanted.start}-${wanted.end}/${info.size}`,
      'Content-Length': length,
    };
    response.writeHead(206, { ...headers, ...part, 'Accept-Ranges': 'bytes' });
    return send(request, response, file, wanted);
  }
  const compressed = acceptsBrotli(request) ? await stat(`${file}.br`).catch(() => undefined) : undefined;
  if (compressed?.isFile()) {
    response.writeHead(200, { ...headers, 'Content-Encoding': 'br', 'Content-Length': compressed.size });
    return send(request, response, `${file}.br`);
  }
  response.writeHead(200, { ...headers, 'Content-Length': info.size, 'Accept-Ranges': 'bytes' });
  return send(request, response, file);
}

/**
 * The file that an address names, or undefined when it lies outside the folders.
 *
 * @param {string} address
 * @param {[string, string][]} folders
 */
function locate(address, folders) {
  let pathname;
  try {
    pathname = decodeURIComponent(address.split(/[?#]/, 1)[0] ?? '/');
  } catch {
    return undefined;
  }
  if (pathname.includes('\0')) return undefined;
  if (pathname.endsWith('/')) pathname += 'index.html';
  const [beginning, folder] = folders.find(([start]) => pathname.startsWith(start)) ?? [];
  if (beginning === undefined || folder === undefined) return undefined;
  const top = path.resolve(folder);
  const file = path.join(top, pathname.slice(beginning.length));
  return file.startsWith(top + path.sep) ? file : undefined;
}

/**
 * @param {string | undefined} header the Range header
 * @param {number} size bytes of the file
 * @returns {{ start: number, end: number } | 'everything' | 'outside'} both ends inclusive
 */
function range(header, size) {
  const match = /^bytes=(\d*)-(\d*)$/.exec(header ?? '');
  const [, first = '', last = ''] = match ?? [];
  if (match === null || (first === '' && last === '')) return 'everything';
  const start = first === '' ? Math.max(0, size - Number(last)) : Number(first);
  const end = first === '' || last === '' ? size - 1 : Math.min(Number(last), size - 1);
  return start > end ? 'outside' : { start, end };
}

/** @param {import('node:http').IncomingMessage} request */
function acceptsBrotli(request) {
  return /(^|[\s,])br\s*(,|;\s*q=(0\.\d*[1-9]|1)|$)/.test(String(request.headers['accept-encoding'] ?? ''));
}

/**
 * @param {import('node:http').IncomingMessage} request
 * @param {import('node:http').ServerResponse} response
 * @param {string} file
 * @param {{ start: number, end: number }} [part]
 */
async function send(request, response, file, part) {
  if (request.method === 'HEAD') return void response.end();
  await pipeline(createReadStream(file, part), response);
}

/**
 * @param {import('node:http').ServerResponse} response
 * @param {number} status
 * @param {string} message
 */
function refuse(response, status, message) {
  response.writeHead(status, { ...securityHeaders, 'Content-Type': 'text/plain; charset=utf-8' });
  response.end(`${message}\n`);
}

/**
 * Listens on `port`, or on the next free one. Port 0 lets the system choose.
 *
 * @param {import('node:http').Server} server
 * @param {{ port: number, host?: string }} where
 * @returns {Promise<string>} the address, with a slash at its end
 */
export async function listen(server, { port, host = '127.0.0.1' }) {
  for (let candidate = port; ; candidate++) {
    try {
      await new Promise((resolve, reject) => {
        server.once('error', reject);
        server.listen(candidate, host, () => {
          server.off('error', reject);
          resolve(undefined);
        });
      });
      const bound = /** @type {import('node:net').AddressInfo} */ (server.address());
      return `http://${host}:${bound.port}/`;
    } catch (error) {
      server.removeAllListeners('listening');
      const busy = error instanceof Error && 'code' in error && error.code === 'EADDRINUSE';
      if (!busy || candidate - port >= PORTS_TO_TRY) throw error;
    }
  }
}

/** Serves dist/ on PORT (4173) and HOST (this machine only), and says where. */
export async function serveApp() {
  const root = fileURLToPath(new URL('../dist', import.meta.url));
  const host = process.env['HOST'] ?? '127.0.0.1';
  const address = await listen(createSite({ root }), { port: Number(process.env['PORT'] ?? 4173), host });
  console.log(`\n  ReactDance is at ${address}\n  Ctrl+C stops it.\n`);
}

if (isProgram(import.meta.url)) await serveApp();
