import { VSMShadowMap, WebGLRenderer } from 'three';
import { createEdgeSmoothing, type Rect, type EdgeSmoothing } from './edge-smoothing';
import { createCopyPresenter, createDirectPresenter, type FramePresenter } from './frame-presenter';
import { AppError } from '../common/error';
import type { PictureSize } from '../common/picture';

/** The whole canvas, or one half of a split view. */
export type Viewport = 'whole' | 'left' | 'right';

/** More pixels than this along a CSS pixel cost more than they show. */
const MAX_PIXEL_RATIO = 2;

/**
 * @param preserved whether a frame stays in the drawing buffer until the next one
 * @param antialias whether edges are drawn smooth
 */
function createRenderer(preserved: boolean, antialias: boolean): WebGLRenderer {
  try {
    return new WebGLRenderer({
      antialias,
      powerPreference: 'high-performance',
      preserveDrawingBuffer: preserved,
    });
  } catch {
    throw new AppError(
      'webgl-missing',
      'The stage needs WebGL 2, which this browser does not offer here.',
      'Turn on hardware acceleration in the browser settings, or open the page in a current Chrome, Edge, Firefox or Safari.',
    );
  }
}

/**
 * Place of a viewport in a canvas, CSS pixels. three.js rounds left edge and width down to whole pixels one by one, so
 * the right half is a pixel wider: else it would miss the last column of a canvas of odd width.
 *
 * @param size of the canvas, CSS pixels
 * @param pixelRatio pixels along a CSS pixel
 */
export function placeOf(viewport: Viewport, { width, height }: PictureSize, pixelRatio: number): Rect {
  if (viewport === 'whole') return { left: 0, bottom: 0, width, height };
  if (viewport === 'left') return { left: 0, bottom: 0, width: width / 2, height };
  return { left: width / 2, bottom: 0, width: width / 2 + 1 / pixelRatio, height };
}

/** The canvas in the page and the renderer that draws on it. */
export class Canvas {
  readonly renderer: WebGLRenderer;
  /** Smooths the edges of what has been drawn, for renderers without a graphics card; null where they are drawn smooth. */
  readonly edgeSmoothing: EdgeSmoothing | null;
  private readonly presenter: FramePresenter;
  private cssSize = { width: 1, height: 1 };
  private resolution = 1;
  private contextLost = false;

  /**
   * @param softwareRendered whether WebGL is drawn by software, without a graphics card
   * @param fixedSize of pictures that leave the page one by one; null follows the host
   * @param onLost called when the browser takes the graphics card away (true), and when it is there again (false)
   * @param onPresented called when a frame that was not `presented` at once is on the page
   * @throws {AppError} `webgl-missing` when the browser has no WebGL 2.
   */
  constructor(
    host: HTMLElement,
    softwareRendered: boolean,
    private readonly fixedSize: PictureSize | null,
    private readonly onLost: (lost: boolean) => void,
    onPresented: () => void,
  ) {
    const copied = softwareRendered && fixedSize === null;
    this.renderer = createRenderer(copied, !softwareRendered);
    this.edgeSmoothing = softwareRendered ? createEdgeSmoothing(this.renderer) : null;
    this.presenter = copied
      ? createCopyPresenter(this.renderer, onPresented)
      : createDirectPresenter(this.renderer);
    const { domElement, shadowMap, info } = this.renderer;
    domElement.style.display = 'block';
    domElement.addEventListener('webglcontextlost', this.loseContext);
    domElement.addEventListener('webglcontextrestored', this.restoreContext);
    shadowMap.enabled = true;
    shadowMap.type = VSMShadowMap;
    // A frame may have two viewports, whose draw calls and triangles are counted together.
    info.autoReset = false;
    host.append(this.element);
  }

  /** What is on the page and takes the pointer. */
  get element(): HTMLElement {
    return this.presenter.element;
  }

  /** In CSS pixels. */
  get size(): PictureSize {
    return this.cssSize;
  }

  /** Whether the browser has taken the graphics card away for now. */
  get lost(): boolean {
    return this.contextLost;
  }

  /** Size of the picture at full resolution, pixels. */
  get pixels(): PictureSize {
    const { width, height } = this.cssSize;
    return { width: Math.floor(width * this.pixelRatio), height: Math.floor(height * this.pixelRatio) };
  }

  /** Takes another size in CSS pixels; false when there is nothing to draw on. */
  resize(width: number, height: number): boolean {
    if (width === 0 || height === 0) return false;
    this.cssSize = { width, height };
    this.renderer.setPixelRatio(this.pixelRatio * this.resolution);
    this.renderer.setSize(width, height);
    return true;
  }

  /** Sets the share of the pixels along each side, 0 to 1; true when it is another one, and what was drawn is lost. */
  setResolution(share: number): boolean {
    if (share === this.resolution) return false;
    this.resolution = share;
    this.renderer.setPixelRatio(this.pixelRatio * this.resolution);
    return true;
  }

  /** Limits drawing to a viewport, and returns its place in CSS pixels. */
  setViewport(viewport: Viewport): Rect {
    const place = placeOf(viewport, this.cssSize, this.renderer.getPixelRatio());
    const { left, bottom, width, height } = place;
    this.renderer.setScissorTest(viewport !== 'whole');
    this.renderer.setViewport(left, bottom, width, height);
    this.renderer.setScissor(left, bottom, width, height);
    return place;
  }

  /** Says that all of a frame has been asked of the renderer. */
  frameDone(): void {
    this.presenter.frameDone();
  }

  /** Whether the last frame is on the page or comes there by itself. */
  get presented(): boolean {
    return this.presenter.presented;
  }

  /** Says whether the page has much else to do, see `FramePresenter`. */
  setBusy(busy: boolean): void {
    this.presenter.setBusy(busy);
  }

  /** To be called where the size is fixed: the canvas of the page stays. */
  dispose(): void {
    this.edgeSmoothing?.dispose();
    const { domElement } = this.renderer;
    domElement.removeEventListener('webglcontextlost', this.loseContext);
    domElement.removeEventListener('webglcontextrestored', this.restoreContext);
    this.renderer.dispose();
    // Browsers allow few contexts; one that is not given back waits for the garbage collector.
    this.renderer.forceContextLoss();
  }

  /** Device pixels along a CSS pixel. */
  private get pixelRatio(): number {
    return this.fixedSize ? 1 : Math.min(window.devicePixelRatio, MAX_PIXEL_RATIO);
  }

  private readonly loseContext = (event: Event): void => {
    event.preventDefault();
    this.setLost(true);
  };

  private readonly restoreContext = (): void => {
    this.setLost(false);
  };

  private setLost(lost: boolean): void {
    this.contextLost = lost;
    // Browsers show a lost canvas as a white area with the sign of a missing picture.
    this.element.style.visibility = lost ? 'hidden' : '';
    this.onLost(lost);
  }
}
