import type { PictureSize } from '../common/picture';
import type { BodyLibrary } from './body/library';
import { CameraRig } from './camera/camera-rig';
import { easing, isFar, measureCouple, nearestAngle, type Couple } from './camera/framing';
import { planHeading } from './camera/heading-plan';
import { Canvas, type Viewport } from './canvas';
import { perVertexMaterial, perPixelMaterial } from './dancer/body-material';
import { Dancers } from './dancer/dancers';
import { screenBounds } from './edge-smoothing';
import { StageScene } from './scene';

/** What a renderer is made for. */
interface RendererOptions {
  readonly library: BodyLibrary;
  /** Whether WebGL is drawn by software, without a graphics card. */
  readonly softwareRendered: boolean;
  /** Size of pictures that are drawn one by one off the page, pixels; null follows the host element. */
  readonly fixedSize: PictureSize | null;
  /** Called when something has changed and a frame has to be drawn. */
  readonly invalidate: () => void;
  /** Called when the browser takes the graphics card away (true), and when it is there again (false). */
  readonly onLost: (lost: boolean) => void;
  /** Called when a frame that was presented late is on the page. */
  readonly onPresented: () => void;
}

/** Time constants with which the lights follow the camera's heading, seconds; shorter while the couple rests. */
const LIGHT_TAU = { dancing: 0.7, resting: 0.3 } as const;
/** A turn of the lights too small to be seen, radians. */
const LIGHT_STILL = 0.03;
/** How far a body extends beyond its joints, metres. */
const BODY_MARGIN = 0.2;

const WHOLE = ['whole'] as const satisfies readonly Viewport[];
const HALVES = ['left', 'right'] as const satisfies readonly Viewport[];

/** Draws one moment of the dance: poses the dancers, moves camera and lights along and renders every viewport. */
export class StageRenderer {
  readonly canvas: Canvas;
  readonly rig: CameraRig;
  readonly contents: StageScene;
  private seconds = 0;
  private poseStale = true;
  private couple: Couple = measureCouple([]);
  /** Motions of the couple that the camera's headings are planned for. */
  private planned: Dancers['couple'] = null;
  private lightHeading: number;
  /** Whether the shadow map holds a dancer's shadow, or nothing yet. */
  private shadowsStale = true;
  private drawnFrames = 0;

  constructor(
    host: HTMLElement,
    { library, softwareRendered, fixedSize, invalidate, onLost, onPresented }: RendererOptions,
  ) {
    const lost = (isLost: boolean): void => {
      this.shadowsStale = true;
      if (!isLost) invalidate();
      onLost(isLost);
    };
    this.canvas = new Canvas(host, softwareRendered, fixedSize, lost, onPresented);
    this.contents = new StageScene(
      new Dancers(library, softwareRendered ? perVertexMaterial : perPixelMaterial, invalidate),
    );
    const reducedMotion = fixedSize ? null : matchMedia('(prefers-reduced-motion: reduce)');
    this.rig = new CameraRig(this.canvas.element, invalidate, reducedMotion);
    this.lightHeading = this.rig.heading;
  }

  /** Frames drawn since the renderer was made. */
  get frames(): number {
    return this.drawnFrames;
  }

  /** Takes another moment of the dance; false when it is the same. */
  setTime(seconds: number): boolean {
    if (seconds === this.seconds) return false;
    this.seconds = seconds;
    this.poseStale = true;
    return true;
  }

  /** Says that dancers or their motions have changed. */
  invalidatePose(): void {
    this.poseStale = true;
  }

  /** Poses the dancers at the current moment, unless they are, and returns where the couple is. */
  pose(): Couple {
    if (this.poseStale) {
      this.poseStale = false;
      this.couple = this.contents.dancers.pose(this.seconds);
    }
    return this.couple;
  }

  /** Moment of the dance that is shown, seconds. */
  get time(): number {
    return this.seconds;
  }

  /**
   * Plans how the camera turns with the couple on the stage.
   *
   * @param passing whether the dance is one of many that pass by, for which a camera that has a plan keeps it
   */
  planCamera(passing: boolean): void {
    const { couple } = this.contents.dancers;
    const same = couple?.filter((motion, i) => motion === this.planned?.[i]).length ?? 0;
    if (same === 2 || (same === 1 && passing)) return;
    this.planned = couple;
    this.rig.setPlan(couple && planHeading(...couple));
  }

  /** Turns the lights to the camera at once. */
  alignLights(): void {
    this.lightHeading = this.rig.heading;
  }

  /** Takes another size in CSS pixels; false when there is nothing to draw on. */
  resize(width: number, height: number): boolean {
    if (!this.canvas.resize(width, height)) return false;
    this.fitCamera();
    return true;
  }

  /** Gives the camera the shape of one viewport. */
  fitCamera(): void {
    const { width, height } = this.canvas.size;
    const { split } = this.contents.dancers;
    this.rig.resize(split ? width / 2 : width, height);
    this.rig.zoomsToPointer = !split;
  }

  /**
   * Draws a frame, `dt` seconds after the one before.
   *
   * @returns whether dancers, camera or lights are still moving by themselves
   */
  draw(dt: number): boolean {
    const { canvas, rig, contents } = this;
    const { dancers } = contents;
    const crossfading = dancers.advance(dt);
    if (crossfading) this.invalidatePose();
    const danced = this.poseStale;
    const couple = this.pose();
    const cameraMoves = rig.update(dt, { couple, seconds: this.seconds, danced });
    const lightsTurn = this.turnLights(dt, danced);
    contents.centreOn(couple, this.lightHeading);
    dancers.setLowDetail(isFar(rig.camera.position, couple, canvas.renderer.domElement.height));
    canvas.renderer.info.reset();
    for (const viewport of dancers.split ? HALVES : WHOLE) this.drawViewport(viewport);
    canvas.frameDone();
    this.drawnFrames++;
    return cameraMoves || crossfading || lightsTurn;
  }

  dispose(): void {
    this.rig.dispose();
    this.contents.dispose();
    this.canvas.dispose();
  }

  /** Lets the lights follow the camera's heading; true while they visibly do. */
  private turnLights(dt: number, danced: boolean): boolean {
    const turn = nearestAngle(this.rig.heading, this.lightHeading) - this.lightHeading;
    if (this.rig.jumps) {
      this.lightHeading += turn;
      return false;
    }
    this.lightHeading += turn * easing(dt, danced ? LIGHT_TAU.dancing : LIGHT_TAU.resting);
    return Math.abs(turn) > LIGHT_STILL;
  }

  private drawViewport(viewport: Viewport): void {
    const { renderer, edgeSmoothing } = this.canvas;
    const place = this.canvas.setViewport(viewport);
    const occupied = this.contents.arrange(viewport, this.seconds) > 0;
    // Without a graphics card an empty floor's shadows cost as much as a couple's.
    renderer.shadowMap.autoUpdate = this.shadowsStale || occupied;
    this.shadowsStale = occupied;
    renderer.render(this.contents.scene, this.rig.camera);
    if (!edgeSmoothing) return;
    const rect = screenBounds(this.contents.dancers.visibleJoints(), this.rig.camera, place, BODY_MARGIN);
    if (rect) edgeSmoothing.smooth(rect);
  }
}
