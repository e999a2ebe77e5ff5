import { Color, Scene } from 'three';
import type { SolvedMotion } from '../motion/skeleton/clip';
import { createCameraRig } from './camera/camera-rig';
import { createBodyLibrary, type BodyLibrary } from './body/library';
import { createCanvas, type Picture, type PictureSize } from './canvas';
import { createCast, type OtherMode, type Part } from './dancer/dancers';
import { createContacts } from './contact-shadows';
import { areaOf } from './edge-smoothing';
import { createFloor } from './floor';
import { AppError } from '../common/error';
import { easing, type Framing, isFar, measureCouple, nearestTurn, type View } from './camera/framing';
import { createHalves, type Labels } from './split-labels';
import { createLights } from './lights';
import { createLoop, idleLoop } from './frame-loop';
import { cornerPaint, pixelPaint } from './dancer/body-material';
import { createSharpness } from './dynamic-resolution';
import { drawnByProcessor } from './frame-presenter';
import { createShows, type Shown } from './overlays/overlays';
import { LOOKS, ROLES, type Role, type Theme } from './theme';

export type { PictureSize };

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

/** A stage that is filmed instead of seen: it is never on the page and draws only when told to. */
export interface Film extends Stage {
  readonly canvas: HTMLCanvasElement;
  /**
   * Draws the moment `seconds` now; `dt` seconds have passed since the picture before it.
   *
   * @throws {AppError} `webgl-lost` when the graphics card has taken the context away.
   */
  shoot(seconds: number, dt: number): void;
}

/** How dancers come onto the stage. */
export interface Entrance {
  /** Whose part was made, the reactor's unless said otherwise: coarse layer and other take are of the same part. */
  readonly made?: Role;
  /** Whether who is there already passes over to the other dance. */
  readonly softly?: boolean;
}

/** The room in which the two dance. */
export interface Stage {
  /** Whether the processor draws, for want of a graphics card. */
  readonly byProcessor: boolean;
  /** Puts dancers on the stage or takes them off (null); a role that is left out stays as it is. */
  setDancers(dancers: { leader?: SolvedMotion | null; reactor?: SolvedMotion | null }, how?: Entrance): void;
  /**
   * Sets the reactor of the coarse layer alone, which `shown.ghost` lets be seen through the reactor, and that of the
   * other take, which is seen where the other take has a half of its own.
   */
  setCoarse(motion: SolvedMotion | null, other?: SolvedMotion | null): void;
  /** Shows another reactor to compare with, or none. */
  setOther(other: Other | null): void;
  setShown(shown: Shown): void;
  /** Shows the moment `seconds` of both motions. */
  setTime(seconds: number): void;
  setTheme(theme: Theme): void;
  setCamera(view: View): void;
  /** Moves the couple to the right by CSS pixels, out from under what lies over the picture. */
  standAside(pixels: number): void;
  /**
   * Says whether the page has much else to do. Where there is no graphics card it then stays free while a picture is
   * drawn, and there are a quarter fewer.
   */
  setPatient(patient: boolean): void;
  /** Brings both dancers into the picture. */
  frameBoth(): void;
  /** How the couple is seen now, for a film to be framed alike. */
  framing(): Framing;
  frameAs(framing: Framing): void;
  /** Size of the picture when nothing moves. */
  pictureSize(): PictureSize;
  /**
   * An empty stage beside this one, for pictures of `size` that leave the page. It shares nothing that moves, so
   * that neither disturbs the other.
   *
   * @throws {AppError} `webgl-missing` when the browser gives no second context.
   */
  film(size: PictureSize): Film;
  /** Calls `listener` after every drawn frame; returns how to stop that. */
  onFrame(listener: (stats: StageStats) => void): () => void;
  stats(): StageStats;
  /** Resolves when the bodies of all dancers on the stage have been made and drawn. */
  ready(): Promise<void>;
  /** World positions of the 22 joints as drawn right now (22 x 3, metres); zeros without a motion. */
  jointPositions(part: Part): Float32Array;
  dispose(): void;
}

/** Another reactor beside the one on the stage. */
export interface Other {
  readonly motion: SolvedMotion;
  /** `ghost`: seen through, in the same picture; else the half of the picture that it has, the reactor has the other. */
  readonly mode: OtherMode;
  /** What the halves are called. */
  readonly labels: Labels;
}

/** Time constant with which the lights follow the camera's heading, seconds; sooner where a picture waits to be sharp. */
const LIGHT_TAU = { dancing: 0.7, resting: 0.3 } as const;
/** A turn of the lights that nobody sees, radians. */
const LIGHT_STILL = 0.03;

/** How far a body goes beyond its joints, metres. */
const BODY = 0.2;

/** The person's wish for less movement. */
const CALM = '(prefers-reduced-motion: reduce)';

const WHOLE = ['whole'] as const satisfies readonly Picture[];
const HALVES = ['left', 'right'] as const satisfies readonly Picture[];

/**
 * Builds the stage inside `host` and fills it.
 *
 * @throws {AppError} `webgl-missing` when the browser has no WebGL 2.
 */
export function createStage(host: HTMLElement): Stage {
  const library = createBodyLibrary();
  const stage = buildStage(host, library, drawnByProcessor(), null);
  return {
    ...stage,
    dispose() {
      stage.dispose();
      library.dispose();
    },
  };
}

/** @param filmed the size of pictures that are drawn one by one; null follows the host and draws by itself. */
function buildStage(
  host: HTMLElement,
  library: BodyLibrary,
  byProcessor: boolean,
  filmed: PictureSize | null,
): Film {
  const canvas = createCanvas(host, byProcessor, filmed, {
    onRestored() {
      shaded = true;
      loop.invalidate();
    },
    onShown() {
      loop.resume();
    },
  });
  const { renderer } = canvas;

  const scene = new Scene();
  const background = new Color();
  scene.background = background;
  const floor = createFloor();
  scene.add(floor.object);
  const contacts = createContacts();
  scene.add(contacts.object);
  const lights = createLights();
  scene.add(lights.object);
  const cast = createCast(library, byProcessor ? cornerPaint : pixelPaint, () => loop.invalidate());
  const shows = createShows();
  scene.add(cast.object, shows.object);
  const halves = createHalves(host);
  const rig = createCameraRig(canvas.element, () => loop.invalidate(), filmed ? null : matchMedia(CALM));
  const listeners = new Set<(stats: StageStats) => void>();
  let seconds = 0;
  let posed = false;
  let frames = 0;
  /** Whether the shadow map has more than an empty floor in it, or nothing yet. */
  let shaded = true;
  let couple = measureCouple([]);
  let lightHeading = rig.heading;

  /** Brings bones to the current moment, if they are not there yet. */
  function pose(): void {
    if (posed) return;
    posed = true;
    couple = cast.pose(seconds);
  }

  function drawPicture(picture: Picture): void {
    const place = canvas.aim(picture);
    const figures = cast.arrange(picture);
    contacts.update(figures.map(({ joints }) => joints));
    shows.update(figures, seconds);
    // Without a graphics card an empty floor's shadows cost as much as a couple's.
    renderer.shadowMap.autoUpdate = shaded || figures.length > 0;
    shaded = figures.length > 0;
    renderer.render(scene, rig.camera);
    if (!canvas.edges) return;
    const area = areaOf(cast.seen(), rig.camera, place, BODY);
    if (area) canvas.edges.smooth(area);
  }

  const stats = (): StageStats => ({
    drawCalls: renderer.info.render.calls,
    triangles: renderer.info.render.triangles,
    frameMs: loop.frameMs,
    frames,
  });

  function draw(dt: number): boolean {
    if (canvas.lost) return false;
    const passing = cast.advance(dt);
    if (passing) posed = false;
    const danced = !posed;
    pose();
    const moving = rig.update(dt, couple, danced);
    const turn = nearestTurn(rig.heading, lightHeading) - lightHeading;
    lightHeading += rig.jumps ? turn : turn * easing(dt, danced ? LIGHT_TAU.dancing : LIGHT_TAU.resting);
    lights.aim(couple.x, couple.z, lightHeading);
    floor.setCentre(couple.x, couple.z);
    cast.setFar(isFar(rig.camera.position, couple, renderer.domElement.height));
    renderer.info.reset();
    for (const picture of cast.split ? HALVES : WHOLE) drawPicture(picture);
    canvas.drawn();
    frames++;
    const now = stats();
    for (const listener of listeners) listener(now);
    return moving || passing || (!rig.jumps && Math.abs(turn) > LIGHT_STILL);
  }
  const sharpness = createSharpness();
  const loop = filmed
    ? idleLoop
    : createLoop({
        draw,
        shown: () => canvas.shown(),
        due(waited) {
          sharpness.waited(waited);
          canvas.sharpen(sharpness.factor);
        },
        rest() {
          if (canvas.sharpen(1)) loop.flush();
        },
      });

  /** Gives the camera the shape of one picture. */
  function frame(): void {
    const { width, height } = canvas.size;
    rig.resize(cast.split ? width / 2 : width, height);
  }
  const observer = new ResizeObserver(resize);
  observer.observe(host);
  function resize(): void {
    const { width, height } = filmed ?? { width: host.clientWidth, height: host.clientHeight };
    if (!canvas.resize(width, height)) return;
    frame();
    // A resized canvas is empty until it is drawn again.
    loop.flush();
  }

  function setTheme(theme: Theme): void {
    const look = LOOKS[theme];
    background.set(look.background);
    floor.setLook(look);
    contacts.setLook(look);
    lights.setLook(look);
    cast.setLook(look);
    shows.setLook(look);
    loop.invalidate();
  }
  setTheme('dark');
  resize();

  return {
    byProcessor,
    setDancers(next, { made = 'reactor', softly = false } = {}) {
      cast.setMade(made);
      const before = cast.present;
      for (const role of ROLES) {
        const motion = next[role];
        if (motion !== undefined) cast.setMotion(role, motion, softly);
      }
      posed = false;
      pose();
      if (cast.present > before) {
        rig.introduce(couple, before === 0);
        if (before === 0) lightHeading = rig.heading;
      }
      loop.invalidate();
      // The rest of the page tells of a new dance at the same moment; without a graphics card both at once take too long.
      loop.pass();
    },
    setCoarse(motion, other = null) {
      cast.setMotion('coarse', motion);
      cast.setMotion('otherCoarse', other);
      posed = false;
      loop.invalidate();
    },
    setOther(other) {
      const wasSplit = cast.split;
      cast.setMotion('other', other?.motion ?? null);
      cast.setOtherMode(other?.mode ?? 'ghost');
      halves.show(other && cast.split ? other.labels : null);
      posed = false;
      loop.invalidate();
      if (cast.split === wasSplit) return;
      frame();
      pose();
      rig.refit(couple);
    },
    setShown(shown) {
      cast.setShown(shown);
      shows.setShown(shown);
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
    setPatient(patient) {
      if (canvas.setPatient(patient)) loop.flush();
    },
    frameBoth() {
      pose();
      rig.frame(couple);
    },
    framing() {
      pose();
      return rig.framing(couple);
    },
    frameAs(framing) {
      pose();
      rig.frameAs(framing, couple);
      lightHeading = rig.heading;
    },
    pictureSize: () => canvas.pixels,
    film: (size) => buildStage(document.createElement('div'), library, byProcessor, size),
    canvas: renderer.domElement,
    shoot(at, dt) {
      if (canvas.lost) {
        throw new AppError(
          'webgl-lost',
          'The graphics card stopped drawing the video.',
          'Try again, with a smaller picture or fewer other tabs open.',
        );
      }
      if (at !== seconds) {
        seconds = at;
        posed = false;
      }
      draw(dt);
    },
    onFrame(listener) {
      listeners.add(listener);
      return () => listeners.delete(listener);
    },
    stats,
    async ready() {
      await cast.dressed();
      loop.flush();
    },
    jointPositions(part) {
      pose();
      return cast.joints(part);
    },
    dispose() {
      loop.dispose();
      observer.disconnect();
      listeners.clear();
      rig.dispose();
      cast.dispose();
      shows.dispose();
      halves.dispose();
      lights.dispose();
      floor.dispose();
      contacts.dispose();
      canvas.dispose();
    },
  };
}
