import { createPlayer, loadSong } from './audio/client';
import { createGenerator } from './model/client';
import { writeBvh } from './motion/bvh-write';
import { mountBar } from './ui/bar';
import { createChooser } from './ui/chooser';
import { loadDemo } from './ui/demo';
import { mountDropTarget } from './ui/drop-target';
import { type DroppedFile, modelAmong } from './ui/dropped';
import { createFiles } from './ui/files';
import { mountFirstVisit } from './ui/first-visit';
import { mountFootLock } from './ui/foot-lock';
import { createGeneration } from './ui/generation';
import { mountGuidance } from './ui/guidance';
import { mountKeyboard } from './ui/keyboard';
import { mountKeysDialog } from './ui/keys-dialog';
import { readLeader } from './ui/leader-reader';
import { createModelLink } from './ui/model-link';
import { mountOptions } from './ui/options';
import { readParameters } from './ui/parameters';
import { createPlayback } from './ui/playback';
import { mountProblemDialog } from './ui/problem-dialog';
import { stageProblem } from './ui/problems';
import { mountProgress } from './ui/progress';
import { reactorMotion } from './ui/reactor-motion';
import { saveText } from './ui/save';
import { reactorFileName } from './ui/selectors';
import type { Services } from './ui/services';
import { mountStageControls } from './ui/stage-controls';
import { apply, createAppStore, opened, told, themeSet, watch } from './ui/store';
import { firstTheme, followSystemTheme, showTheme } from './ui/theme';
import { mountTimeline } from './ui/timeline';
import { mountTransport } from './ui/transport';
import { mountUnderstood } from './ui/understood';
import { createStage, type Stage } from './view/stage';

/** The places that index.html leaves for the panels. */
function place(id: string): HTMLElement {
  const element = document.getElementById(id);
  if (!element) throw new Error(`index.html has no element "${id}".`);
  return element;
}

// ---- state and the four machines: model, files, generation, playback ----

const store = createAppStore(firstTheme());
const { manifestUrl, backend } = readParameters(location.search, document.baseURI);
const model = createModelLink(store, (onStatus, folder) =>
  createGenerator({ manifestUrl, folder: folder ?? undefined, backend, onStatus }),
);
const files = createFiles(store, { loadSong, readLeader, manifest: model.manifest });
const generation = createGeneration(store, model.generator);
const playback = createPlayback(store, createPlayer());

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
    apply(store, told(stageProblem(error)));
    return null;
  }
}
const stage = openStage();

// ---- the theme, before panels draw with its colours ----

let themeWasChosen = false;
watch(
  store,
  (state) => state.theme,
  (theme) => {
    showTheme(theme, themeWasChosen);
    stage?.setTheme(theme);
    themeWasChosen = true;
  },
);
followSystemTheme((theme) => {
  themeWasChosen = false;
  apply(store, themeSet(theme));
});

// ---- what panels may ask for ----

const choose = createChooser(document.body, (chosen) => void files.open(chosen));
const services: Services = {
  openDropped: (coming) => void openDropped(coming),
  choose,
  rereadLeader: (fps) => void files.rereadLeader(fps),
  playDemo: playback.playFromStart,
  generate: generation.generate,
  cancel: generation.cancel,
  retryModel: model.retry,
  togglePlay: playback.toggle,
  seek: playback.seek,
  frameBoth: () => stage?.frameBoth(),
  saveReactor: () => {
    const { reaction } = store.getState();
    const motion = reactorMotion(store.getState());
    if (!reaction || !motion) return;
    saveText(writeBvh(motion), reactorFileName(reaction.inputs));
    apply(store, opened(null));
  },
};

async function openDropped(coming: Promise<readonly DroppedFile[]>): Promise<void> {
  const dropped = await coming;
  const folder = modelAmong(dropped);
  if (!folder) await files.open(dropped.map(({ file }) => file));
  else if (await model.open(folder)) generation.generate();
}

// ---- panels ----

mountBar(place('bar'), store, services);
mountStageControls(stageHost, store, services);
mountFirstVisit(stageHost, store, services);
mountProgress(stageHost, store, services);
mountProblemDialog(stageHost, store, services);
mountDropTarget(stageHost, store, services);
mountTransport(place('time'), store, services);
mountTimeline(place('time'), store, services);
mountGuidance(place('panel'), store, services);
mountOptions(place('panel'), store, services);
mountFootLock(place('panel'), store, services);
mountUnderstood(place('panel'), store, services);
mountKeysDialog(document.body, store, services);
mountKeyboard(store, services);

// ---- state to stage and page ----

watch(
  store,
  (state) => state.leader?.motion ?? null,
  (leader) => stage?.setDancers({ leader }),
);
watch(store, reactorMotion, (reactor) => stage?.setDancers({ reactor }));
watch(
  store,
  (state) => state.playback.time,
  (time) => stage?.setTime(time),
);
watch(
  store,
  (state) => state.camera,
  (camera) => stage?.setCamera(camera),
);
/** The couple stands beside the words of the first visit, where there is room beside them. */
const roomBeside = matchMedia('(min-width: 761px)');
const ASIDE = 200;
watch(
  store,
  (state) => state.visiting,
  (visiting) => stage?.standAside(visiting && roomBeside.matches ? ASIDE : 0),
);

// ---- what is there from the start ----

void loadDemo(store, files, new URL('demo/', document.baseURI), {
  readReactor: async (bvh) => (await readLeader({ text: bvh, fps: null })).motion,
  settled: model.manifest,
});

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
