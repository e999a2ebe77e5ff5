/**
 * Assembles the page, from top to bottom: the store, the features that change it, the stage, the actions of the panels,
 * the panels, and what is loaded at the start.
 */
import { AudioPlayer, loadSong } from './audio/client';
import { ownName, ownStorage } from './common/own-name';
import { createGenerator } from './model/client';
import { inspectLeader, type LeaderRequest, readLeader } from './motion/client';
import { registerServiceWorker } from './offline/register';
import { clearStorage, measureStorage } from './offline/storage-usage';
import { measureDance } from './quality/client';
import { bindStage, openCamera, leaveRoomForControls, withPartRead } from './stage-binding';
import { createOffscreenStage } from './view/offscreen-stage';
import { createFigures } from './view/figures';
import { mountLostNote } from './view/lost-note';
import { createStage, type Stage } from './view/stage';
import { createDownloads } from './ui/download/downloads';
import { saveFile } from './ui/download/save-and-share';
import { demoFetched, loadDemo } from './ui/files/demo';
import { mountDropTarget } from './ui/files/drop-target';
import { createInOrder, openDropped, unpackedOrReported } from './ui/files/dropped';
import { createFileChooser } from './ui/files/file-chooser';
import { FileLoader } from './ui/files/file-loader';
import { isProject, isVideoName } from './ui/files/file-type';
import { mountGivenDialog } from './ui/files/given-dialog';
import { openGiven } from './ui/files/given-files';
import { mountImportPanel } from './ui/files/joints/import-panel';
import { RememberedJointsStorage } from './ui/files/joints/remembered';
import { mountImportReport } from './ui/files/import-report';
import { ModelLink } from './ui/files/model-link';
import { OfferedLeaders } from './ui/files/offered';
import { readParameters } from './ui/files/parameters';
import { createCoarseLayer } from './ui/generation/coarse-layer';
import { createEarlierDance } from './ui/generation/earlier-dance';
import { mountMotionSwitches } from './ui/generation/motion-switches';
import { Generation } from './ui/generation/generation';
import { mountOptions } from './ui/generation/options';
import { mountProgress } from './ui/generation/progress';
import { VariationMaker } from './ui/generation/variations';
import { mountGuidance } from './ui/guidance/guidance';
import { tabLockApis } from './ui/project/tab-lock';
import { mountAutosaveNote } from './ui/project/autosave-note';
import { Project } from './ui/project/project';
import { ProjectDatabase } from './ui/project/storage';
import { createQuality } from './ui/quality/quality';
import { readReference } from './ui/quality/quality-reference';
import { mountQualityStrip } from './ui/quality/quality-strip';
import { mountBar } from './ui/shell/bar';
import { mountFirstVisit } from './ui/shell/first-visit';
import { mountKeyboard } from './ui/shell/keyboard';
import { mountKeysDialog } from './ui/shell/keys-dialog';
import { mountNewVersion } from './ui/shell/new-version';
import { syncPreferences } from './ui/shell/preferences';
import { mountProblemDialog } from './ui/shell/problem-dialog';
import { mountStageControls } from './ui/shell/stage-controls';
import { mountTheme, systemTheme, watchSystemTheme } from './ui/shell/theme';
import { mountToast } from './ui/shell/toast';
import { downloadChosen } from './ui/store/actions/download';
import { problemShown } from './ui/store/actions/notices';
import { referenceLoaded } from './ui/store/actions/reaction';
import { updateSet } from './ui/store/actions/view';
import { stageProblem } from './ui/store/problems';
import type { FileChoice, Services } from './ui/store/services';
import { undoLast } from './ui/store/history/asked';
import { redone } from './ui/store/history/history';
import { apply, createAppStore } from './ui/store/store';
import { mountCompareSwitch } from './ui/takes/compare-switch';
import { mountTakes } from './ui/takes/takes-panel';
import { mountUndoKeys } from './ui/takes/undo';
import { PlaybackControl } from './ui/timeline/playback';
import { mountTimeline } from './ui/timeline/timeline';
import { mountTransport } from './ui/timeline/transport';
import { openBeside } from './ui/video/beside';
import { createVideoFeature } from './ui/video/open';
import { mountVideoLane, VideoTrack } from './ui/video/video-lane';

// ---- the store and the features that change it ----

const store = createAppStore(systemTheme());
syncPreferences(store, ownStorage, watchSystemTheme);
const { manifestUrl, backend } = readParameters(location.search, document.baseURI);
const model: ModelLink = new ModelLink(store, (onStatus, folder) =>
  createGenerator({
    manifestUrl,
    folder: folder ?? undefined,
    backend,
    onStatus: (status) => {
      onStatus(status);
      if (status.kind === 'manifest') return firstDanceFetched;
      // Opening the graphs takes all of a small processor: the couple of an earlier visit is drawn before.
      return status.kind === 'open' ? project.coupleShown : undefined;
    },
  }),
);
const rememberedJoints = new RememberedJointsStorage(ownStorage);
const readers = {
  loadSong,
  readLeader: (request: LeaderRequest, signal?: AbortSignal) =>
    readLeader({ ...request, remembered: rememberedJoints.read() }, signal),
  manifest: model.manifest,
};
const files = new FileLoader(store, readers, {
  openVideo: (file) => video.open(file),
  cancel: () => {
    video.cancel();
    offered.cancel();
  },
});
const offered = new OfferedLeaders(store, files, new URL('leaders/', document.baseURI));
const videoTrack = new VideoTrack();
const video = createVideoFeature(
  store,
  () => files,
  () => place('stage'),
  { seek: (seconds) => playback.seek(seconds), togglePlay: () => playback.toggle() },
  videoTrack,
);
const project = new Project(store, files, readers, {
  stage: () => stage,
  storage: new ProjectDatabase(ownName('reactdance')),
  tabs: tabLockApis(globalThis),
  persistence: navigator.storage,
});
// The browser reads while the page is built.
const restoring = project.restore();
/** On a slow connection the first couple and its song come before model and offline copy, which are twenty times as large. */
const firstDanceFetched = restoring.then((restored) => (restored ? undefined : demoFetched(store)));
const generation = new Generation(store, model.generator);
const variations = new VariationMaker(store, model.generator);
createCoarseLayer(store, model.generator);
createEarlierDance(store);
const playback = new PlaybackControl(store, new AudioPlayer());
createQuality(store, measureDance);
const offline = import.meta.env.PROD
  ? registerServiceWorker(new URL('service-worker.js', document.baseURI), firstDanceFetched, () => {
      apply(store, updateSet(true));
    })
  : null;

// ---- the stage; the page works without one ----

// Before anything is drawn in the theme's colours.
mountTheme(store);
const stageHost = place('stage');
const stage = openStage(stageHost);
// A processor needs about 90 s for 30 s of video at full size: there the visitor has to ask for a large one.
if (stage?.softwareRendered) apply(store, downloadChosen({ size: 'stage' }));

// ---- the actions of the panels ----

/** What is chosen later is opened later, however long an archive takes. */
const inOrder = createInOrder();
const services: Services = {
  openDropped: (reading) =>
    void openDropped(reading, store, { open: openFiles }, model, generation.generate, inOrder),
  useGiven: (chosen) => void files.open(chosen),
  choose: createFileChooser(document.body, (chosen, what) => void openChosen(chosen, what)),
  openOffered: (file) => void offered.open(file),
  recordVideo: () => void video.record(),
  rereadLeader: (source, options) => void files.rereadLeader(source, options),
  readAgain: files.readAgain,
  inspectLeader: ({ files, options }) =>
    inspectLeader({ files, options, remembered: rememberedJoints.read() }),
  playDemo: playback.playFromStart,
  generate: generation.generate,
  cancel: () => {
    generation.cancel();
    variations.cancel();
  },
  undo: () => undoLast(store, files),
  redo: () => {
    apply(store, redone());
    // Starting over may have been undone before the demo was there.
    if (store.getState().demo === 'loading') void openDemo();
  },
  makeVariations: variations.make,
  drawFigure: stage && createFigures(stage.library, stage.softwareRendered).draw,
  pickVariation: variations.pick,
  retryModel: () => {
    if (model.retry()) generation.resume();
  },
  reopenModel: () => void model.reopen().then((opened) => opened && generation.generate()),
  togglePlay: playback.toggle,
  seek: playback.seek,
  showMoment: (measure, seconds) => {
    playback.loopAround(seconds);
    stage?.focusOn(MEASURED[measure], seconds);
  },
  frameBoth: () => stage?.frameBoth(),
  stepCamera: (turn, factor) => stage?.stepCamera(turn, factor),
  ...createDownloads(store, {
    openVideoStage: stage && ((size, begin) => openCamera(stage, store, size, begin, createOffscreenStage)),
    openBesideVideo: () => {
      const shown = videoTrack.video;
      return stage && shown
        ? (size, begin) =>
            openBeside(size, shown, begin, (half) =>
              openCamera(stage, store, half, begin, createOffscreenStage),
            )
        : null;
    },
    stageSize: () => stage?.pictureSize() ?? null,
  }),
  leaderVideo: () => {
    if (videoTrack.video) return 'open';
    return isVideoName(store.getState().leader?.name ?? '') ? 'gone' : 'none';
  },
  saveProject: () => void saveProject(),
  storeHere: project.takeOver,
  clearProject: () => {
    generation.cancel();
    project.clear();
    void openDemo();
  },
  measureStorage: () => measureStorage(globalThis),
  clearStorage: () =>
    clearStorage(globalThis).then(
      () => true,
      () => false,
    ),
  loadUpdate: () => offline?.activateUpdate(),
  reload: () => location.reload(),
};

// ---- panels ----

mountBar(place('bar'), store, services);
for (const mount of [
  mountStageControls,
  mountCompareSwitch(stage !== null),
  mountFirstVisit,
  mountProgress,
  mountToast,
  mountNewVersion,
  mountAutosaveNote,
  mountProblemDialog,
  mountGivenDialog,
  mountDropTarget,
])
  mount(stageHost, store, services);
mountTransport(place('time'), store, services);
mountTimeline(place('time'), store, services, [mountVideoLane(videoTrack), mountQualityStrip]);
for (const mount of [mountGuidance, mountOptions, mountMotionSwitches, mountTakes, mountImportReport])
  mount(place('panel'), store, services);
mountImportPanel(rememberedJoints)(document.body, store, services);
mountKeysDialog(document.body, store, services);
mountKeyboard(store, services);
mountUndoKeys(services);
// The model is downloaded on when the connection is there again.
addEventListener('online', services.retryModel);
if (stage) {
  mountLostNote(stage, stageHost);
  bindStage(stage, withPartRead(store));
  leaveRoomForControls(stage, store);
}

// ---- what is loaded at the start ----

void restoring.then((restored) => (restored ? undefined : openDemo()));
// The scores of recorded dances are only shown beside others, so they may come last and may be missing.
void firstDanceFetched
  .then(model.manifest)
  .then(({ id }) => readReference(manifestUrl, id))
  .then(
    (reference) => apply(store, referenceLoaded(reference)),
    () => undefined,
  );

/** Where on the stage a moment of each measure is seen. */
const MEASURED = { feet: 'feet', closeness: 'trunks', beats: 'couple', seams: 'couple' } as const;

/** An element of index.html that panels are mounted in. */
function place(id: string): HTMLElement {
  const element = document.getElementById(id);
  if (!element) throw new Error(`index.html has no element "${id}".`);
  return element;
}

/** Null, and a problem on the page, where the browser cannot draw the 3D view. */
function openStage(host: HTMLElement): Stage | null {
  const picture = document.createElement('div');
  picture.className = 'picture';
  picture.setAttribute('role', 'img');
  // A click gives it the focus, so that keys go to the stage; Tab passes it by.
  picture.tabIndex = -1;
  picture.setAttribute('aria-label', 'Leader in blue and reactor in orange, dancing');
  host.append(picture);
  try {
    return createStage(picture);
  } catch (error) {
    apply(store, problemShown(stageProblem(error)));
    return null;
  }
}

async function openChosen(chosen: readonly File[], as: FileChoice): Promise<void> {
  const files = chosen.map((file) => ({ path: file.name, file }));
  const found = await inOrder(() => unpackedOrReported(files, store));
  if (found)
    await openFiles(
      found.map(({ file }) => file),
      as,
    );
}

/** A project has its own song and leader, so other files beside it are not read. */
async function openFiles(chosen: readonly File[], as?: FileChoice): Promise<void> {
  const projectFile = chosen.find(({ name }) => isProject(name));
  if (projectFile) await project.open(projectFile);
  else await openGiven(chosen, store, files, inOrder, as);
}

async function saveProject(): Promise<void> {
  const file = await project.toFile();
  if (file) saveFile(new Blob([file.bytes], { type: 'application/zip' }), file.name);
}

function openDemo(): Promise<void> {
  return loadDemo(store, files, new URL('demo/', document.baseURI), {
    readReactor: async (bytes) =>
      (await readLeader({ files: [{ name: 'reactor.bvh', bytes }], options: {} })).motion,
    manifest: model.manifest,
  });
}

declare global {
  interface Window {
    /** Read by browser tests; nothing here changes anything. */
    readonly reactdance: {
      readonly stage: Stage | null;
      readonly store: { readonly getState: typeof store.getState };
    };
  }
}
Object.defineProperty(window, 'reactdance', { value: { stage, store: { getState: store.getState } } });
