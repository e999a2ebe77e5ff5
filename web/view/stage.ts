import { Color, Scene, VSMShadowMap, WebGLRenderer } from 'three';
import type { SolvedMotion } from '../motion/clip';
import { createBodyLibrary } from './body/library';
import { createCameraRig } from './camera-rig';
import { createContacts } from './contacts';
import { createDancer } from './dancer';
import { ViewError } from './error';
import { createFloor } from './floor';
import { easing, measureCouple, nearestTurn, type View } from './framing';
import { createLights } from './lights';
import { createLoop } from './loop';
import { LOOKS, ROLES, type Role, type Theme } from './theme';

export interface StageStats {
  /** Draw calls of the last frame, shadow passes included. */
  readonly drawCalls: number;
  /** Triangles of the last frame, shadow passes included. */
  readonly triangles: number;
  /** Main-thread milliseconds a frame, median of the last 60. */
  readonly frameMs: number;
  /** Frames drawn since the stage was made. */
  readonly frames: number;
}

/** The room in which the two dance. */
export interface Stage {
  /** Puts dancers on the stage or takes them off (null); a role that is left out stays as it is. */
  setDancers(dancers: { leader?: SolvedMotion | null; reactor?: SolvedMotion | null }): void;
  /** Shows the moment `seconds` of both motions. */
  setTime(seconds: number): void;
  setTheme(theme: Theme): void;
  setCamera(view: View): void;
  /** Moves the couple to the right by CSS pixels, out from under what lies over the picture. */
  standAside(pixels: number): void;
  /** Brings both dancers into the picture. */
  frameBoth(): void;
  /** Calls `listener` after every drawn frame; returns how to stop that. */
  onFrame(listener: (stats: StageStats) => void): () => void;
  stats(): StageStats;
  /** Resolves when the bodies of all dancers on the stage have been made and drawn. */
  ready(): Promise<void>;
  /** World positions of the 22 joints as drawn right now (22 x 3, metres); zeros without a motion. */
  jointPositions(role: Role): Float32Array;
  dispose(): void;
}

/** Sharper than this costs more than it shows. */
const MOST_PIXELS = 2;
/** Time constant with which the lights follow the camera's heading, seconds. */
const LIGHT_TAU = 0.7;

function createRenderer(): WebGLRenderer {
  try {
    return new WebGLRenderer({ antialias: true, powerPreference: 'high-performance' });
  } catch {
    throw new ViewError(
      'webgl-missing',
      'The stage needs WebGL 2, which this browser does not offer here.',
      'Turn on hardware acceleration in the browser settings, or open the page in a current Chrome, Edge, Firefox or Safari.',
    );
  }
}

/**
 * Builds the stage inside `host` and fills it.
 *
 * @throws {ViewError} `webgl-missing` when the browser has no WebGL 2.
 */
export function createStage(host: HTMLElement): Stage {
  const renderer = createRenderer();
  const canvas = renderer.domElement;
  canvas.style.display = 'block';
  host.append(canvas);
  renderer.shadowMap.enabled = true;
  renderer.shadowMap.type = VSMShadowMap;

  const scene = new Scene();
  const background = new Color();
  scene.background = background;
  const floor = createFloor();
  scene.add(floor.object);
  const contacts = createContacts();
  scene.add(contacts.object);
  const lights = createLights();
  scene.add(lights.object);
  const library = createBodyLibrary();
  const dancers = {
    leader: createDancer('leader', library, () => loop.invalidate()),
    reactor: createDancer('reactor', library, () => loop.invalidate()),
  };
  for (const role of ROLES) scene.add(dancers[role].object);
  const rig = createCameraRig(canvas, () => loop.invalidate());
  const listeners = new Set<(stats: StageStats) => void>();
  let seconds = 0;
  let posed = false;
  let lost = false;
  let frames = 0;
  let couple = measureCouple([]);
  let lightHeading = rig.heading;

  const onStage = (): Role[] => ROLES.filter((role) => dancers[role].motion !== null);

  /** Brings bones to the current moment, if they are not there yet. */
  function pose(): void {
    if (posed) return;
    posed = true;
    for (const role of onStage()) dancers[role].pose(seconds);
    if (onStage().length === 2) {
      dancers.leader.attend(dancers.reactor);
      dancers.reactor.attend(dancers.leader);
    }
    const joints = onStage().map((role) => dancers[role].jointPositions());
    couple = measureCouple(joints);
    contacts.update(joints);
  }

  const stats = (): StageStats => ({
    drawCalls: renderer.info.render.calls,
    triangles: renderer.info.render.triangles,
    frameMs: loop.frameMs,
    frames,
  });

  const loop = createLoop((dt) => {
    if (lost) return false;
    const danced = !posed;
    pose();
    const moving = rig.update(dt, couple, danced);
    const turn = nearestTurn(rig.heading, lightHeading) - lightHeading;
    lightHeading += turn * easing(dt, LIGHT_TAU);
    lights.aim(couple.x, couple.z, lightHeading);
    floor.setCentre(couple.x, couple.z);
    renderer.render(scene, rig.camera);
    frames++;
    const now = stats();
    for (const listener of listeners) listener(now);
    return moving || Math.abs(turn) > 0.01;
  });

  function resize(): void {
    const { clientWidth: width, clientHeight: height } = host;
    if (width === 0 || height === 0) return;
    renderer.setPixelRatio(Math.min(window.devicePixelRatio, MOST_PIXELS));
    renderer.setSize(width, height);
    rig.resize(width, height);
    // A resized canvas is empty until it is drawn again.
    loop.flush();
  }
  const observer = new ResizeObserver(resize);
  observer.observe(host);

  const onLost = (event: Event): void => {
    event.preventDefault();
    lost = true;
  };
  const onRestored = (): void => {
    lost = false;
    loop.invalidate();
  };
  canvas.addEventListener('webglcontextlost', onLost);
  canvas.addEventListener('webglcontextrestored', onRestored);

  function setTheme(theme: Theme): void {
    const look = LOOKS[theme];
    background.set(look.background);
    floor.setLook(look);
    contacts.setLook(look);
    lights.setLook(look);
    for (const role of ROLES) dancers[role].setLook(look);
    loop.invalidate();
  }
  setTheme('dark');
  resize();

  return {
    setDancers(next) {
      const before = onStage().length;
      for (const role of ROLES) {
        const motion = next[role];
        if (motion !== undefined) dancers[role].setMotion(motion);
      }
      posed = false;
      pose();
      const now = onStage().length;
      if (now > before) {
        rig.introduce(couple, before === 0);
        if (before === 0) lightHeading = rig.heading;
      }
      loop.invalidate();
    },
    setTime(at) {
      if (at === seconds) return;
      seconds = at;
      posed = false;
      loop.invalidate();
    },
    setTheme,
    setCamera(view) {
      pose();
      rig.setView(view, couple);
    },
    standAside(pixels) {
      rig.shift(pixels);
    },
    frameBoth() {
      pose();
      rig.frame(couple);
    },
    onFrame(listener) {
      listeners.add(listener);
      return () => listeners.delete(listener);
    },
    stats,
    async ready() {
      await Promise.all(ROLES.map((role) => dancers[role].dressed()));
      loop.flush();
    },
    jointPositions(role) {
      pose();
      return dancers[role].jointPositions();
    },
    dispose() {
      loop.dispose();
      observer.disconnect();
      canvas.removeEventListener('webglcontextlost', onLost);
      canvas.removeEventListener('webglcontextrestored', onRestored);
      listeners.clear();
      rig.dispose();
      for (const role of ROLES) dancers[role].dispose();
      library.dispose();
      lights.dispose();
      floor.dispose();
      contacts.dispose();
      renderer.dispose();
      canvas.remove();
    },
  };
}
