import { readdir, readFile } from 'node:fs/promises';
import { createRequire } from 'node:module';
import path from 'node:path';
import { fileURLToPath } from 'node:url';

/** The file in the built page's folder. */
const FILE = 'licences.txt';

/** Licences that this project may ship under, as package.json files name them (SPDX). */
const ALLOWED = new Set(['Apache-2.0', 'ISC', 'MIT', 'MPL-2.0', 'OFL-1.1']);

/** Packages whose code lies inside the file of another package, where the build can't see it. */
const BUNDLED = new Map([
  ['meyda', ['dct', 'fftjs']],
  ['onnxruntime-web', ['onnxruntime-common']],
]);

/**
 * Works of others in the page that are no installed packages: their facts, as a package.json has them, and how they
 * came here. `licence-texts/NAME/*.txt` are their terms.
 */
const NOT_INSTALLED = [
  {
    name: '@mediapipe/pose',
    version: '0.5.1675469404',
    license: 'Apache-2.0',
    author: 'Google LLC',
    repository: 'google/mediapipe',
    changed:
      "The weights of its networks, pose_detection and pose_landmark_full, were converted to ONNX: models/pose/detector.onnx and models/pose/landmarks.onnx. What surrounds the networks (anchors, boxes, regions) was written in TypeScript after MediaPipe's calculators.",
  },
  {
    name: 'earcut',
    version: '3.0.2',
    license: 'ISC',
    author: 'Mapbox',
    repository: 'mapbox/earcut',
    changed: 'Copied into three by its authors.',
  },
  {
    name: 'librosa',
    version: '0.11.0',
    license: 'ISC',
    author: 'librosa development team',
    repository: 'librosa/librosa',
    changed: 'Its functions that the features of a song need were rewritten in TypeScript.',
  },
];

/** Packages with WebAssembly that Emscripten compiled: it contains parts of Emscripten's libraries. */
const EMSCRIPTEN = new Set(['onnxruntime-web', '@mediabunny/aac-encoder']);

/** Texts that packages lack: `licence-texts/NAME/*.txt` are added to those that the package NAME brings. */
const OWN_TEXTS = fileURLToPath(new URL('licence-texts', import.meta.url));

/** Names of files with licence terms. */
const LICENCE_FILE = /^(licen[cs]e|copying|notice)(\.(md|txt))?$/i;

/** In Vite's own licence file, what follows concerns its program: pages contain only a few lines of its core. */
const VITE_PROGRAM = '# Licenses of bundled dependencies';

/** Matches a path up to the folder of the innermost package in it; the group is the package's name. */
const PACKAGE = /^.*\/node_modules\/((?:@[^/]+\/)?[^/]+)(?=\/)/;

/**
 * Two plugins that together write licences.txt into a built page: our own licence, then name, version, licence, author,
 * source and full licence texts of every package that has code, WebAssembly, styles, fonts or weights in the page or its
 * workers, of what was copied or rewritten from others, and where the source code of what is under the MPL is to be
 * had. The build fails when one of them has no text or is under a licence that is not allowed.
 *
 * @returns {{ page: import('vite').Plugin, worker: () => import('vite').Plugin }} `worker` goes to Vite's
 *   `worker.plugins`: workers are bundles of their own, built before the page's is written
 */
export function licences() {
  /** @type {Set<string>} Folders of the packages found so far. */
  const folders = new Set();
  let root = '';
  /** @param {import('vite').Rolldown.OutputBundle} bundle */
  const collect = (bundle) => {
    for (const file of Object.values(bundle)) {
      const origins =
        file.type === 'chunk'
          ? file.moduleIds
          : file.originalFileNames.map((name) => path.resolve(root, name));
      for (const origin of origins) {
        const folder = packageOf(origin);
        if (folder !== undefined) folders.add(folder);
      }
    }
  };
  return {
    page: {
      name: 'licences',
      apply: 'build',
      configResolved: (config) => {
        root = config.root;
      },
      generateBundle: {
        order: 'post',
        async handler(_, bundle) {
          collect(bundle);
          this.emitFile({ type: 'asset', fileName: FILE, source: await licenceTexts([...folders]) });
        },
      },
    },
    worker: () => ({
      name: 'licences-of-worker',
      apply: 'build',
      generateBundle: (_, bundle) => collect(bundle),
    }),
  };
}

/**
 * The folder of the package that a module comes from, or undefined for one of ours.
 *
 * @param {string} id of a module, or the path of a file
 */
function packageOf(id) {
  const [, tool] = /^\0(vite|rolldown)\//.exec(id) ?? [];
  if (tool !== undefined) return path.dirname(createRequire(import.meta.url).resolve(`${tool}/package.json`));
  return PACKAGE.exec(id.replaceAll(path.sep, '/').replace(/^\0/, ''))?.[0];
}

/**
 * @param {string[]} folders of packages
 * @returns {Promise<string>} the content of licences.txt
 */
async function licenceTexts(folders) {
  const inner = folders.flatMap((folder) => {
    const [, name = ''] = PACKAGE.exec(`${folder}/`) ?? [];
    const modules = folder.slice(0, -name.length);
    return (BUNDLED.get(name) ?? []).map((other) => modules + other);
  });
  const sections = await Promise.all([
    ...[...new Set([...folders, ...inner])].map(packageSection),
    ...NOT_INSTALLED.map((facts) => section(facts, [])),
  ]);
  const project = await readFile(new URL('../../LICENSE', import.meta.url), 'utf8');
  const line = '='.repeat(80);
  const introduction = `ReactDance\n\n${project.trim()}\n\nThe page contains software, a font and weights of networks of others, under the terms below.`;
  return `${[introduction, ...sections.sort()].join(`\n\n${line}\n`)}\n`;
}

/**
 * @param {string} folder of a package
 * @returns {Promise<string>} its part of licences.txt
 * @throws when it has no licence text or its licence is not allowed
 */
async function packageSection(folder) {
  const facts = JSON.parse(await readFile(path.join(folder, 'package.json'), 'utf8'));
  return section(facts, await textsIn(folder, LICENCE_FILE));
}

/**
 * @param {{
 *   name: string, version: string, license: string, author?: string | { name: string },
 *   repository?: string | { url: string }, changed?: string
 * }} facts as in a package.json, and what was changed
 * @param {string[]} own licence texts that the package brings
 * @returns {Promise<string>} its part of licences.txt
 * @throws when it has no licence text or its licence is not allowed
 */
async function section({ name, version, license, author, repository, changed }, own) {
  if (!ALLOWED.has(license))
    throw new Error(
      `${name} is in the page, but its licence (${license}) is not one of ${[...ALLOWED].join(', ')}`,
    );
  const texts = [
    ...own,
    ...(await textsIn(path.join(OWN_TEXTS, name), /\.txt$/)),
    ...(EMSCRIPTEN.has(name) ? await textsIn(path.join(OWN_TEXTS, 'emscripten'), /\.txt$/) : []),
  ];
  if (texts.length === 0)
    throw new Error(
      `${name} is in the page, but has no licence text: add one to ${path.join(OWN_TEXTS, name)}`,
    );
  const by = typeof author === 'object' ? author.name : author;
  const source = webAddress(typeof repository === 'object' ? repository.url : repository);
  const facts = [
    `${name} ${version}`,
    `Licence: ${license}`,
    ...(by === undefined ? [] : [`By: ${by}`]),
    ...(source === undefined ? [] : [`Source: ${source}`]),
    ...(license === 'MPL-2.0' ? [`Source code of this version: ${archive(name, version)}`] : []),
    ...(changed === undefined ? [] : [`Changed: ${changed}`]),
  ];
  return [facts.join('\n'), ...texts].join('\n\n');
}

/**
 * Where npm's registry keeps a package, with its source code if that is part of it. The MPL wants recipients to be told.
 *
 * @param {string} name
 * @param {string} version
 */
function archive(name, version) {
  return `https://registry.npmjs.org/${name}/-/${path.posix.basename(name)}-${version}.tgz`;
}

/**
 * @param {string | undefined} repository as in a package.json: an address, or owner/name on GitHub
 * @returns {string | undefined} where a person can read it
 */
function webAddress(repository) {
  return repository
    ?.replace(/^(?=[^/:]+\/[^/:]+$)/, 'https://github.com/')
    .replace(/^git@([^:]+):/, 'https://$1/')
    .replace(/^git(\+https)?:/, 'https:')
    .replace(/\.git$/, '');
}

/**
 * @param {string} folder that need not exist
 * @param {RegExp} wanted file names
 */
async function textsIn(folder, wanted) {
  const entries = await readdir(folder, { withFileTypes: true }).catch(() => []);
  const files = entries.filter((entry) => entry.isFile() && wanted.test(entry.name)).map(({ name }) => name);
  const texts = await Promise.all(files.sort().map((file) => readFile(path.join(folder, file), 'utf8')));
  return texts.map((text) => (text.split(VITE_PROGRAM)[0] ?? '').trim()).filter((text) => text !== '');
}
