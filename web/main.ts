import { createPlayer, loadSong } from './audio/client';
import { createGenerator } from './model/client';
import { clearKept, measureKept } from './offline/storage-usage';
import { keepPage } from './offline/register';
import { openCamera, showOn } from './stage-binding';
import { measureDance } from './quality/client';
import { mountBar } from './ui/shell/bar';
import { createChoices } from './ui/generation/variations';
import { createFileChooser } from './ui/files/file-chooser';
import { createCoarseLayer } from './ui/generation/coarse-layer';
import { loadDemo } from './ui/files/demo';
import { downloadChosen } from './ui/store/actions/download';
import { createDownloads } from './ui/download/downloads';
import { mountDropTarget } from './ui/files/drop-target';
import { FileLoader } from './ui/files/file-loader';
import { mountFirstVisit } from './ui/shell/first-visit';
import { mountFootLock } from './ui/generation/foot-lock';
import { createGeneration } from './ui/generation/generation';
import { mountGuidance } from './ui/guidance/guidance';
import { Project } from './ui/project/project';
import { ProjectDatabase } from './ui/project/storage';
import { mountKeyboard } from './ui/shell/keyboard';
import { mountKeysDialog } from './ui/shell/keys-dialog';
import { readLeader } from './motion/client';
import { createModelLink } from './ui/files/model-link';
import { mountNewVersion } from './ui/shell/new-version';
import { mountToast } from './ui/shell/toast';
import { openDropped } from './ui/files/open-dropped';
import { mountOptions } from './ui/generation/options';
import { readParameters } from './ui/files/parameters';
import { createPlayback } from './ui/timeline/playback';
import { syncPreferences } from './ui/shell/preferences';
import { mountProblemDialog } from './ui/shell/problem-dialog';
import { stageProblem } from './ui/store/problems';
import { mountProgress } from './ui/generation/progress';
import { generatedRole } from './ui/store/roles';
import { createQuality } from './ui/quality/quality';
import { mountQualityStrip } from './ui/quality/quality-strip';
import { readReference } from './ui/quality/quality-reference';
import { canShare, saveFile, shareFile } from './ui/download/save-and-share';
import type { Services } from './ui/store/services';
import { isProject } from './ui/files/file-type';
import { mountStageControls } from './ui/shell/stage-controls';
import { referenceLoaded } from './ui/store/actions/reaction';
import { apply, createAppStore, watch } from './ui/store/store';
import { problemShown } from './ui/store/actions/notices';
import { updateSet } from './ui/store/actions/view';
import { mountCompareSwitch } from './ui/takes/compare-switch';
import { mountUndoKeys } from './ui/takes/undo';
import { mountTakes } from './ui/takes/takes-panel';
import { showTheme, systemTheme, watchSystemTheme } from './ui/shell/theme';
import { mountTimeline } from './ui/timeline/timeline';
import { mountTransport } from './ui/timeline/transport';
import { mountImportReport } from './ui/files/import-report';
import { createStage, type Stage } from './view/stage';

/** The places that index.html leaves for the panels. */
function place(id: string): HTMLElement {
  const element = document.getElementById(id);
  if (!element) throw new Error(`index.html has no element "${id}".`);
  return element;
}

// ---- state and the four machines: model, files, generation, playback ----

const store = createAppStore(systemTheme());
syncPreferences(store, () => localStorage, watchSystemTheme);
const { manifestUrl, backend } = readParameters(location.search, document.baseURI);
const model = createModelLink(store, (onStatus, folder) =>
  createGenerator({ manifestUrl, folder: folder ?? undefined, backend, onStatus }),
);
const readers = { loadSong, readLeader, manifest: model.manifest };
const files = new FileLoader(store, readers);
const project = new Project(store, files, readers, new ProjectDatabase());
const generation = createGeneration(store, model.generator);
const choices = createChoices(store, model.generator, generation.generate);
createCoarseLayer(store, model.generator);
const playback = createPlayback(store, createPlayer());
createQuality(store, measureDance);

// ---- the stage, which the rest can do without ----

const stageHost = place('stage');
const picture = document.createElement('div');
picture.className = 'picture';
picture.setAttribute('role', 'img');
picture.setAttribute('aria-label', 'Leader in blue and reactor in orange, dancing');
stageHost.append(picture);

function openStage(): Stage | null {
  try {
    return createStage(picture);
  } catch (error) {
    apply(store, problemShown(stageProblem(error)));
    return null;
  }
}
const stage = openStage();
// A minute and a half for half a minute of film is not what anybody expects: there, large pictures are to be asked for.
if (stage?.byProcessor) apply(store, downloadChosen({ size: 'stage' }));

// ---- the theme, before panels draw with its colours ----

watch(
  store,
  (state) => state.theme,
  (theme) => {
    showTheme(theme);
  },
);

// Style sheets colour what acts on the made dancer as the stage does.
watch(store, generatedRole, (role) => {
  document.documentElement.dataset['made'] = role;
});

// ---- the page on this device, for the next visit ----

const offline = import.meta.env.PROD
  ? keepPage(new URL('service-worker.js', document.baseURI), () => {
      apply(store, updateSet(true));
    })
  : null;

// ---- what panels may ask for ----

const choose = createFileChooser(document.body, (chosen) => void openFiles(chosen));
const services: Services = {
  openDropped: (coming) => void openDropped(coming, store, { open: openFiles }, model, generation.generate),
  choose,
  rereadLeader: (fps) => void files.rereadLeader(fps),
  playDemo: playback.playFromStart,
  generate: generation.generate,
  cancel: () => {
    generation.cancel();
    choices.cancel();
  },
  makeVariations: choices.make,
  pickVariation: choices.pick,
  retryModel: model.retry,
  togglePlay: playback.toggle,
  seek: playback.seek,
  frameBoth: () => stage?.frameBoth(),
  ...createDownloads(store, {
    camera: stage && ((size) => openCamera(stage, store, size)),
    stageSize: () => stage?.pictureSize() ?? null,
    save: saveFile,
    share: { can: canShare, pass: shareFile },
  }),
  saveProject: () => void saveProject(),
  clearProject: () => {
    generation.cancel();
    project.clear();
    void showDemo();
  },
  measureStorage: () => measureKept(globalThis),
  clearStorage: () =>
    clearKept(globalThis).then(
      () => true,
      () => false,
    ),
  loadUpdate: () => offline?.takeUpdate(),
};

async function saveProject(): Promise<void> {
  const file = await project.toFile();
  if (file) saveFile(new Blob([file.bytes], { type: 'application/zip' }), file.name);
}

/** A project holds song and leader of its own, so nothing that comes along with it is read. */
async function openFiles(chosen: readonly File[]): Promise<void> {
  const projectFile = chosen.find(({ name }) => isProject(name));
  if (projectFile) await project.open(projectFile);
  else await files.open(chosen);
}

// ---- panels ----

mountBar(place('bar'), store, services);
mountStageControls(stageHost, store, services);
mountCompareSwitch(stage !== null)(stageHost, store, services);
mountFirstVisit(stageHost, store, services);
mountProgress(stageHost, store, services);
mountToast(stageHost, store, services);
mountNewVersion(stageHost, store, services);
mountProblemDialog(stageHost, store, services);
mountDropTarget(stageHost, store, services);
mountTransport(place('time'), store, services);
mountTimeline(place('time'), store, services, mountQualityStrip);
mountGuidance(place('panel'), store, services);
mountOptions(place('panel'), store, services);
mountFootLock(place('panel'), store, services);
mountTakes(place('panel'), store, services);
mountImportReport(place('panel'), store, services);
mountKeysDialog(document.body, store, services);
mountKeyboard(store, services);
mountUndoKeys(store);

// ---- state to stage and page ----

if (stage) showOn(stage, store);

/** The couple stands beside the words of the first visit, where there is room beside them. */
const roomBeside = matchMedia('(min-width: 761px)');
const ASIDE = 200;
watch(
  store,
  (state) => state.firstVisit,
  (visiting) => stage?.standAside(visiting && roomBeside.matches ? ASIDE : 0),
);

// ---- what is there from the start ----

function showDemo(): Promise<void> {
  return loadDemo(store, files, new URL('demo/', document.baseURI), {
    readReactor: async (bvh) => (await readLeader({ text: bvh, fps: null })).motion,
    settled: model.manifest,
  });
}

/** The demo is for those who have nothing here yet. */
async function begin(): Promise<void> {
  if (!(await project.restore())) await showDemo();
}
void begin();

// What recorded dances score is only said, so it may come last and may be missing.
void model
  .manifest()
  .then(() => readReference(manifestUrl))
  .then(
    (reference) => apply(store, referenceLoaded(reference)),
    () => undefined,
  );

declare global {
  interface Window {
    /** What browser tests look at; nothing here changes anything. */
    readonly reactdance: {
      readonly stage: Stage | null;
      readonly store: { readonly getState: typeof store.getState };
    };
  }
}
Object.defineProperty(window, 'reactdance', { value: { stage, store: { getState: store.getState } } });
