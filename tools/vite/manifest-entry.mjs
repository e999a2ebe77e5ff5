import { createHash } from 'node:crypto';
import { readFile } from 'node:fs/promises';

const QUERY = /\?manifest-entry$/;

/**
 * Lets a module import the address, size and hash of a file instead of its content:
 * `import file from 'some/file.wasm?manifest-entry'` gives `{ path, bytes, sha256 }`, as a model's manifest has them for
 * its files. The page downloads such a file with progress, verifies it and caches it, like the files of a model.
 *
 * @returns {import('vite').Plugin}
 */
export function manifestEntry() {
  return {
    name: 'manifest-entry',
    enforce: 'pre',
    resolveId: {
      filter: { id: QUERY },
      async handler(source, importer) {
        const file = await this.resolve(source.replace(QUERY, ''), importer, { skipSelf: true });
        return file && `${file.id}?manifest-entry`;
      },
    },
    load: {
      filter: { id: QUERY },
      async handler(id) {
        const file = id.replace(QUERY, '');
        const content = await readFile(file);
        const sha256 = createHash('sha256').update(content).digest('hex');
        return [
          `import path from ${JSON.stringify(`${file}?url`)};`,
          `export default { path, bytes: ${content.length}, sha256: '${sha256}' };`,
        ].join('\n');
      },
    },
  };
}
