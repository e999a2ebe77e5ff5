import type { Theme } from '../common/picture';
import type { Role } from '../common/role';
import { PerspectiveCamera, Scene, WebGLRenderer } from 'three';
import type { SolvedMotion } from '../motion/skeleton/clip';
import { standingHeight } from '../motion/skeleton/kinematics';
import type { BodyLibrary } from './body/library';
import { perPixelMaterial, perVertexMaterial } from './dancer/body-material';
import { Dancer } from './dancer/dancer';
import { createLights } from './lights';
import { LOOKS } from './theme';

/** A dancer in one moment, as a small picture shows it. */
export interface Figure {
  readonly motion: SolvedMotion;
  readonly seconds: number;
  readonly role: Role;
  /** Direction from which it is seen, radians about y; 0 looks from +z. */
  readonly heading: number;
  readonly theme: Theme;
}

/** Draws dancers alone, on nothing, into canvases of the page. */
export interface Figures {
  /** Draws a figure as soon as its body is there, or clears the canvas (null); a later call for a canvas replaces it. */
  readonly draw: (canvas: HTMLCanvasElement, figure: Figure | null) => void;
}

const FIELD_OF_VIEW = 22;
/** The middle of what is seen, the eye, and the height of the picture there, for a dancer as tall as 1. */
const [TARGET_HEIGHT, EYE_HEIGHT, VIEW_HEIGHT] = [0.56, 0.77, 1.27];
/** Time between two looks whether a picture is finished, milliseconds. */
const POLL_MS = 4;

/**
 * @param library of bodies, shared with the stage
 * @param softwareRendered whether WebGL is drawn by software, without a graphics card
 */
export function createFigures(library: BodyLibrary, softwareRendered: boolean): Figures {
  const pending = new Map<HTMLCanvasElement, Figure | null>();
  let studio: Studio | null = null;
  let running = false;

  async function drawPending(): Promise<void> {
    for (;;) {
      const [next] = pending;
      if (!next) return;
      const [canvas, figure] = next;
      pending.delete(canvas);
      const picture =
        figure && (await (studio ??= new Studio(library, softwareRendered)).picture(figure, canvas));
      if (pending.has(canvas)) continue;
      const context = canvas.getContext('2d');
      context?.clearRect(0, 0, canvas.width, canvas.height);
      if (picture) context?.putImageData(picture, 0, 0);
    }
  }

  return {
    draw(canvas, figure) {
      pending.set(canvas, figure);
      if (running) return;
      running = true;
      void drawPending()
        // Without its pictures the page works as before.
        .catch((error: unknown) => console.warn('Figures cannot be drawn:', error))
        .finally(() => (running = false));
    },
  };
}

/** A renderer of its own, with lights and one dancer of each role. */
class Studio {
  private readonly renderer = new WebGLRenderer({ alpha: true, antialias: true });
  private readonly scene = new Scene();
  private readonly camera = new PerspectiveCamera(FIELD_OF_VIEW, 1, 1, 12);
  private readonly lights = createLights();
  private readonly dancers: Readonly<Record<Role, Dancer>>;

  constructor(library: BodyLibrary, softwareRendered: boolean) {
    const material = softwareRendered ? perVertexMaterial : perPixelMaterial;
    const dancer = (role: Role): Dancer => new Dancer(role, library, material(), () => undefined);
    this.dancers = { leader: dancer('leader'), reactor: dancer('reactor') };
    this.scene.add(this.lights.object);
    for (const { object, body } of Object.values(this.dancers)) {
      body.setLowDetail(true);
      this.scene.add(object);
    }
  }

  /** The picture of a figure, of the size of the canvas. */
  async picture(figure: Figure, { width, height }: HTMLCanvasElement): Promise<ImageData> {
    const { renderer, scene, camera, dancers } = this;
    const dancer = dancers[figure.role];
    for (const one of Object.values(dancers)) one.show(one === dancer);
    dancer.setMotion(figure.motion);
    await dancer.bodyReady();
    dancer.body.setLook(LOOKS[figure.theme]);
    dancer.pose(figure.seconds);
    this.aim(dancer.jointPositions(), figure);
    camera.aspect = width / height;
    camera.updateProjectionMatrix();
    renderer.setSize(width, height, false);
    await renderer.compileAsync(scene, camera);
    renderer.render(scene, camera);
    return this.read(width, height);
  }

  /** Places camera and lights before a dancer. */
  private aim([x = 0, , z = 0]: Float32Array, { motion, heading, theme }: Figure): void {
    const size = standingHeight(motion.offsets);
    const distance = (size * VIEW_HEIGHT) / 2 / Math.tan((FIELD_OF_VIEW * Math.PI) / 360);
    const [across, ahead] = [Math.sin(heading) * distance, Math.cos(heading) * distance];
    this.camera.position.set(x + across, size * EYE_HEIGHT, z + ahead);
    this.camera.lookAt(x, size * TARGET_HEIGHT, z);
    this.lights.setLook(LOOKS[theme]);
    this.lights.place(x, z, heading);
  }

  /**
   * What was drawn in this task, once it is done. It is fetched through a buffer, behind a fence: a canvas that is drawn
   * into another one holds up the page until all that is drawn meanwhile is done, the stage too, which takes long where
   * software draws.
   */
  private async read(width: number, height: number): Promise<ImageData> {
    const gl = this.renderer.getContext() as WebGL2RenderingContext;
    const buffer = gl.createBuffer();
    gl.bindBuffer(gl.PIXEL_PACK_BUFFER, buffer);
    gl.bufferData(gl.PIXEL_PACK_BUFFER, width * height * 4, gl.STREAM_READ);
    gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, 0);
    gl.bindBuffer(gl.PIXEL_PACK_BUFFER, null);
    const fence = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    gl.flush();
    while (fence && gl.getSyncParameter(fence, gl.SYNC_STATUS) !== gl.SIGNALED && !gl.isContextLost())
      await new Promise((resolve) => setTimeout(resolve, POLL_MS));
    gl.deleteSync(fence);
    const pixels = new Uint8Array(width * height * 4);
    gl.bindBuffer(gl.PIXEL_PACK_BUFFER, buffer);
    gl.getBufferSubData(gl.PIXEL_PACK_BUFFER, 0, pixels);
    gl.bindBuffer(gl.PIXEL_PACK_BUFFER, null);
    gl.deleteBuffer(buffer);
    return upright(pixels, width, height);
  }
}

/** Pixels of WebGL as a picture of a canvas: from the top down, and colours not multiplied by how opaque they are. */
function upright(pixels: Uint8Array, width: number, height: number): ImageData {
  const picture = new ImageData(width, height);
  for (let row = 0; row < height; row++)
    picture.data.set(
      pixels.subarray((height - 1 - row) * 4 * width, (height - row) * 4 * width),
      row * 4 * width,
    );
  const { data } = picture;
  for (let i = 0; i < data.length; i += 4) {
    const opacity = data[i + 3]! / 255;
    if (opacity > 0) for (let color = i; color < i + 3; color++) data[color] = data[color]! / opacity;
  }
  return picture;
}
