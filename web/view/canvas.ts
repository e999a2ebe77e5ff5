import { VSMShadowMap, WebGLRenderer } from 'three';
import { createEdges, type Area, type Edges } from './edge-smoothing';
import { ViewError } from './error';
import { copySheet, plainSheet } from './frame-presenter';

/** A picture of the couple over the whole canvas, or one of its two halves. */
export type Viewport = 'whole' | 'left' | 'right';

/** The canvas in the page and the renderer that draws on it. */
export interface Canvas {
  readonly renderer: WebGLRenderer;
  /** What is on the page and takes the pointer. */
  readonly element: HTMLElement;
  /** In CSS pixels. */
  readonly size: { readonly width: number; readonly height: number };
  /** Whether the browser has taken the graphics card away for now. */
  readonly lost: boolean;
  /** The most pixels that a picture has at this size. */
  readonly pixels: PictureSize;
  /** Takes another size; false when there is nothing to draw on. */
  resize(width: number, height: number): boolean;
  /** Takes so much of the pixels along each side, 0 to 1; true when that is another share, and what was drawn is lost. */
  sharpen(factor: number): boolean;
  /** Says where the next picture goes, and returns that place in CSS pixels. */
  aim(viewport: Viewport): Area;
  /** What smooths the edges of a picture where they are not drawn smooth, for want of a graphics card. */
  readonly edges: Edges | null;
  /** All of a picture has been drawn. */
  drawn(): void;
  /** Whether what was drawn is on the page or comes there by itself. */
  shown(): boolean;
  /** Whether the page stays free while a picture is drawn; true when one has to be drawn at once, see `Sheet`. */
  setPatient(patient: boolean): boolean;
  dispose(): void;
}

/** Pixels. */
export interface PictureSize {
  readonly width: number;
  readonly height: number;
}

/** Sharper than this costs more than it shows. */
const MOST_PIXELS = 2;

/**
 * @param kept whether pictures stay on the canvas until the next one
 * @param smooth whether edges are smooth as drawn
 */
function createRenderer(kept: boolean, smooth: boolean): WebGLRenderer {
  try {
    return new WebGLRenderer({
      antialias: smooth,
      powerPreference: 'high-performance',
      preserveDrawingBuffer: kept,
    });
  } catch {
    throw new ViewError(
      'webgl-missing',
      'The stage needs WebGL 2, which this browser does not offer here.',
      'Turn on hardware acceleration in the browser settings, or open the page in a current Chrome, Edge, Firefox or Safari.',
    );
  }
}

/**
 * @param byProcessor whether the processor draws, for want of a graphics card
 * @param filmed the size of pictures that leave the page one by one; null follows the host
 * @param onRestored called when a lost graphics card is there again
 * @param onShown called when a picture that was not `shown` at once is on the page
 * @throws {ViewError} `webgl-missing` when the browser has no WebGL 2.
 */
export function createCanvas(
  host: HTMLElement,
  byProcessor: boolean,
  filmed: PictureSize | null,
  { onRestored, onShown }: { readonly onRestored: () => void; readonly onShown: () => void },
): Canvas {
  const copied = byProcessor && filmed === null;
  const renderer = createRenderer(copied, !byProcessor);
  const edges = byProcessor ? createEdges(renderer) : null;
  const sheet = copied ? copySheet(renderer, onShown) : plainSheet(renderer);
  const { element } = sheet;
  renderer.domElement.style.display = 'block';
  host.append(element);
  renderer.shadowMap.enabled = true;
  renderer.shadowMap.type = VSMShadowMap;
  // A frame may be two pictures, whose calls and triangles are counted together.
  renderer.info.autoReset = false;

  let size = { width: 1, height: 1 };
  let sharpness = 1;
  let lost = false;
  const ratio = (): number => (filmed ? 1 : Math.min(window.devicePixelRatio, MOST_PIXELS));
  const lose = (event: Event): void => {
    event.preventDefault();
    lost = true;
  };
  const restore = (): void => {
    lost = false;
    onRestored();
  };
  renderer.domElement.addEventListener('webglcontextlost', lose);
  renderer.domElement.addEventListener('webglcontextrestored', restore);

  return {
    renderer,
    element,
    edges,
    drawn: () => {
      sheet.drawn();
    },
    shown: () => sheet.shown(),
    setPatient: (patient) => sheet.setPatient(patient),
    get size() {
      return size;
    },
    get lost() {
      return lost;
    },
    resize(width, height) {
      if (width === 0 || height === 0) return false;
      size = { width, height };
      renderer.setPixelRatio(ratio() * sharpness);
      renderer.setSize(width, height);
      return true;
    },
    get pixels() {
      return { width: Math.floor(size.width * ratio()), height: Math.floor(size.height * ratio()) };
    },
    sharpen(factor) {
      if (factor === sharpness) return false;
      sharpness = factor;
      renderer.setPixelRatio(ratio() * sharpness);
      return true;
    },
    aim(viewport) {
      const { width, height } = size;
      const left = viewport === 'right' ? width / 2 : 0;
      const wide = viewport === 'whole' ? width : width / 2;
      renderer.setScissorTest(viewport !== 'whole');
      renderer.setViewport(left, 0, wide, height);
      renderer.setScissor(left, 0, wide, height);
      return { left, bottom: 0, width: wide, height };
    },
    dispose() {
      sheet.dispose();
      edges?.dispose();
      renderer.domElement.removeEventListener('webglcontextlost', lose);
      renderer.domElement.removeEventListener('webglcontextrestored', restore);
      renderer.dispose();
      // Browsers allow few contexts; one that is not given back waits for the garbage collector.
      if (filmed) renderer.forceContextLoss();
      element.remove();
    },
  };
}
