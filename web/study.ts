/** Assembles the blind test, which `?study` opens in the place of the app. */
import { AudioPlayer, loadSong } from './audio/client';
import { AppError } from './common/error';
import { fetchShipped } from './common/fetch';
import { ownStorage } from './common/own-name';
import { createGenerator, type Generator } from './model/client';
import { readLeader } from './motion/client';
import { saveFile } from './ui/download/save-and-share';
import { readParameters } from './ui/files/parameters';
import { systemTheme } from './ui/shell/theme';
import { builtInSet } from './ui/study/built-in-set';
import { SavedSession } from './ui/study/session';
import { Study } from './ui/study/study';
import { mountLostNote } from './view/lost-note';
import { createStage, type Stage } from './view/stage';

const theme = systemTheme();
document.documentElement.dataset['theme'] = theme;
document.title = 'ReactDance: which partner dances better?';

const host = document.createElement('main');
host.className = 'study-stage';
host.setAttribute('aria-label', 'Two couples side by side, A on the left and B on the right');

let model: Promise<Generator> | null = null;

/** Loads the model when the first dance needs it; again after a failure. */
function generator(onStatus: (text: string) => void): Promise<Generator> {
  const { manifestUrl, backend } = readParameters(location.search, document.baseURI);
  model ??= createGenerator({
    manifestUrl,
    backend,
    onStatus: (status) => {
      if (status.kind === 'download') onStatus('Loading the model');
    },
  }).catch((error: unknown) => {
    model = null;
    throw error;
  });
  return model;
}

/** A file of the page. @throws {AppError} `page-part-missing` */
async function ownFile(path: string): Promise<Blob> {
  try {
    return await (await fetchShipped(new URL(path, document.baseURI))).blob();
  } catch (cause) {
    throw new AppError(
      'page-part-missing',
      `${path} of this page could not be loaded.`,
      'Check the connection, then try again.',
      { cause },
    );
  }
}

function openStage(): Stage | null {
  try {
    const stage = createStage(host);
    stage.setTheme(theme);
    mountLostNote(stage, host);
    return stage;
  } catch (error) {
    host.textContent = error instanceof AppError ? `${error.message} ${error.hint}` : String(error);
    return null;
  }
}

const page = document.createElement('div');
page.className = 'study';
page.append(host);
document.body.replaceChildren(page);
const stage = openStage();
const study = new Study({
  stage,
  player: new AudioPlayer(),
  readLeader: (request) => readLeader(request),
  builtIn: (onStatus) =>
    builtInSet({
      file: ownFile,
      readLeader: (name, bytes) => readLeader({ files: [{ name, bytes }], options: {} }),
      loadSong: (file, audio) => loadSong(file, audio),
      generator: () => generator(onStatus),
    }),
  storage: new SavedSession(ownStorage),
  saveFile,
  seed: () => crypto.getRandomValues(new Uint32Array(1))[0]!,
  now: () => performance.now(),
});
page.append(study.element);
document.addEventListener('keydown', (event) => {
  if (study.handleKey(event)) event.preventDefault();
});
