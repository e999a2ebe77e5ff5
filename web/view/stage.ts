import { ROLES, type Role } from '../common/role';
import type { SolvedMotion } from '../motion/skeleton/clip';
import { createBodyLibrary, type BodyLibrary } from './body/library';
import type { Detail } from './camera/focus';
import type { Covered } from './camera/orbit-camera';
import type { DancerName, OtherMode } from './dancer/dancers';
import { createDynamicResolution } from './dynamic-resolution';
import { createFrameLoop, idleLoop, type FrameLoop } from './frame-loop';
import { isSoftwareRendered } from './frame-presenter';
import type { Framing, View } from '../common/framing';
import { onPixelSize } from '../common/pixel-size';
import type { VisibleOverlays, Theme, PictureSize } from '../common/picture';
import { createSplitLabels, type Labels, type SplitLabels } from './split-labels';
import { StageRenderer } from './stage-renderer';
import { LOOKS } from './theme';

interface StageStats {
  /** Draw calls of the last frame, shadow passes included. */
  readonly drawCalls: number;
  /** Triangles of the last frame, shadow passes included. */
  readonly triangles: number;
  /** Frames drawn since the stage was made. */
  readonly frames: number;
}

/** How new motions are put on the stage. */
export interface DancerOptions {
  /** Role that the model made, the reactor's by default; coarse layer and other take have the same role. */
  readonly made?: Role;
  /** Whether dancers who are on the stage already crossfade to their new motion. */
  readonly crossfade?: boolean;
}

/** Another take to compare with the one on the stage. */
interface OtherTake {
  readonly motion: SolvedMotion;
  /** `ghost`: see-through in the same picture; else the half of a split view that it has, the first take has the other. */
  readonly mode: OtherMode;
  /** Names of the two halves of a split view. */
  readonly labels: Labels;
}

/**
 * Builds the stage inside `host` and fills it.
 *
 * @throws {AppError} `webgl-missing` when the browser has no WebGL 2.
 */
export function createStage(host: HTMLElement): Stage {
  return new Stage(host, createBodyLibrary(), isSoftwareRendered(), null);
}

/** The 3D view of the couple. */
export class Stage {
  protected readonly view: StageRenderer;
  private readonly loop: FrameLoop;
  private readonly splitLabels: SplitLabels;
  private readonly lostListeners = new Set<(lost: boolean) => void>();

  /**
   * @param library of bodies, shared with offscreen stages
   * @param softwareRendered whether WebGL is drawn by software, without a graphics card
   * @param fixedSize of pictures that are drawn one by one; null follows the host and draws by itself
   */
  constructor(
    private readonly host: HTMLElement,
    readonly library: BodyLibrary,
    readonly softwareRendered: boolean,
    private readonly fixedSize: PictureSize | null,
  ) {
    this.view = new StageRenderer(host, {
      library,
      softwareRendered,
      fixedSize,
      invalidate: () => this.loop.invalidate(),
      onLost: (lost) => {
        for (const listener of this.lostListeners) listener(lost);
      },
      onPresented: () => this.loop.resume(),
    });
    this.splitLabels = createSplitLabels(host);
    this.loop = fixedSize ? idleLoop : this.createFrameLoop();
    if (!fixedSize) onPixelSize(host, () => this.resize());
    this.setTheme('dark');
    this.resize();
  }

  /** Puts dancers on the stage or takes them off (null); a role that is left out stays as it is. */
  setDancers(
    motions: { leader?: SolvedMotion | null; reactor?: SolvedMotion | null },
    { made = 'reactor', crossfade = false }: DancerOptions = {},
  ): void {
    const { dancers } = this.view.contents;
    dancers.setMade(made);
    const before = dancers.present;
    for (const role of ROLES) {
      const motion = motions[role];
      if (motion !== undefined) dancers.setMotion(role, motion, crossfade);
    }
    this.view.invalidatePose();
    // Only the dancer moves while the settings do, never the camera.
    this.view.planCamera(!crossfade);
    const couple = this.view.pose();
    if (dancers.present > before) {
      this.view.rig.frameNewcomers(couple, this.view.time, before === 0);
      if (before === 0) this.view.alignLights();
    }
    this.loop.release();
    this.loop.invalidate();
    // The rest of the page shows a new dance at the same moment, which crossfades; without a graphics card both at once
    // take too long.
    if (crossfade) this.loop.delay();
  }

  /**
   * Sets the motions of the coarse layer alone: that of the first take, which the `ghost` overlay shows through the
   * dancer, and that of the other take, which is seen where the other take has a half of its own.
   */
  setCoarse(motion: SolvedMotion | null, other: SolvedMotion | null = null): void {
    const { dancers } = this.view.contents;
    dancers.setMotion('coarse', motion);
    dancers.setMotion('otherCoarse', other);
    this.view.invalidatePose();
    this.loop.invalidate();
  }

  /** Shows another take to compare with, or none. */
  setOther(other: OtherTake | null): void {
    const { dancers } = this.view.contents;
    const wasSplit = dancers.split;
    dancers.setMotion('other', other?.motion ?? null);
    dancers.setOtherMode(other?.mode ?? 'ghost');
    this.splitLabels.show(other && dancers.split ? other.labels : null);
    this.view.invalidatePose();
    this.loop.invalidate();
    if (dancers.split === wasSplit) return;
    this.view.fitCamera();
    this.view.rig.refit(this.view.pose());
  }

  /** Shows the dance before a change as a ghost in the same picture; null ends that, at once or fading it out. */
  setEarlier(motion: SolvedMotion | null, fade = false): void {
    const { dancers } = this.view.contents;
    if (motion === null && fade) dancers.fadeOut('earlier');
    else dancers.setMotion('earlier', motion);
    this.view.invalidatePose();
    this.loop.invalidate();
  }

  setOverlays(overlays: VisibleOverlays): void {
    this.view.contents.dancers.setOverlays(overlays);
    this.view.contents.overlays.setVisible(overlays);
    this.loop.invalidate();
  }

  /** Shows the moment `seconds` of all motions. */
  setTime(seconds: number): void {
    if (this.view.setTime(seconds)) this.loop.invalidate();
  }

  setTheme(theme: Theme): void {
    this.view.contents.setLook(LOOKS[theme]);
    this.loop.invalidate();
  }

  setCamera(view: View): void {
    this.view.rig.setView(view, this.view.pose(), this.view.time);
  }

  /** Leaves room for what lies over the picture. */
  leaveRoom(covered: Covered): void {
    this.view.rig.leaveRoom(covered);
  }

  /**
   * Says whether the page has much else to do. Where there is no graphics card it then stays responsive while a frame
   * is drawn, at about a quarter fewer frames a second.
   */
  setBusy(busy: boolean): void {
    this.view.canvas.setBusy(busy);
  }

  /**
   * Says that new frames will come in a moment. Where there is no graphics card, pictures of the old ones would take
   * the processor from the model: they are left out, so that the new ones come sooner.
   */
  expectFrames(): void {
    if (this.softwareRendered) this.loop.hold();
  }

  /** Turns the camera about what it looks at (radians) and changes its distance by a factor. */
  stepCamera(turn: number, factor: number): void {
    this.view.rig.step(turn, factor);
  }

  /** Brings both dancers into the picture. */
  frameBoth(): void {
    this.view.rig.frame(this.view.pose(), this.view.time);
  }

  /** Shows a detail of the moment `seconds` from where it is seen, until the camera is moved in another way. */
  focusOn(detail: Detail, seconds: number): void {
    const { rig, contents } = this.view;
    const made = contents.dancers.madeAt(seconds);
    if (made) rig.focusOn(detail, made, seconds, this.view.pose());
  }

  /** Frames both dancers again if the camera still shows a detail. */
  endFocus(): void {
    this.view.rig.endFocus(this.view.pose());
  }

  /** How the couple is framed now, for another stage to frame it alike. */
  framing(): Framing {
    return this.view.rig.framing(this.view.pose());
  }

  frameAs(framing: Framing): void {
    this.view.rig.frameAs(framing, this.view.pose(), this.view.time);
    this.view.alignLights();
  }

  /** Size of the picture when nothing moves, pixels. */
  pictureSize(): PictureSize {
    return this.view.canvas.pixels;
  }

  /** Calls `listener` when the browser stops drawing (true), and when it goes on (false). */
  onLost(listener: (lost: boolean) => void): void {
    this.lostListeners.add(listener);
  }

  stats(): StageStats {
    const { calls, triangles } = this.view.canvas.renderer.info.render;
    return { drawCalls: calls, triangles, frames: this.view.frames };
  }

  /** Resolves when the bodies of all dancers on the stage have been made and drawn. */
  async ready(): Promise<void> {
    await this.view.contents.dancers.bodiesReady();
    this.loop.flush();
  }

  /** World positions of the 22 joints as drawn right now (22 x 3, metres); zeros without a motion. */
  jointPositions(name: DancerName): Float32Array {
    this.view.pose();
    return this.view.contents.dancers.joints(name);
  }

  /** Draws a frame `dt` seconds after the one before; true asks for another. */
  protected drawFrame(dt: number): boolean {
    return !this.view.canvas.lost && this.view.draw(dt);
  }

  private createFrameLoop(): FrameLoop {
    const { canvas } = this.view;
    const resolution = createDynamicResolution();
    return createFrameLoop({
      draw: (dt) => this.drawFrame(dt),
      presented: () => canvas.presented,
      beforeFrame(waitedMs) {
        resolution.frameWaited(waitedMs);
        canvas.setResolution(resolution.share);
      },
      atRest: () => {
        if (canvas.setResolution(1)) this.loop.flush();
      },
    });
  }

  private resize(): void {
    const { width, height } = this.fixedSize ?? {
      width: this.host.clientWidth,
      height: this.host.clientHeight,
    };
    // A resized canvas is empty until it is drawn again.
    if (this.view.resize(width, height)) this.loop.flush();
  }
}
