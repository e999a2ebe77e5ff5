import type { WebGLRenderer } from 'three';

/** Presents rendered frames on the page, directly or through a 2D copy. */
export interface FramePresenter {
  /** What is on the page and takes the pointer. */
  readonly element: HTMLElement;
  /** Says that all of a frame has been asked of the renderer. */
  frameDone(): void;
  /** Whether the last frame is on the page or comes there by itself. */
  readonly presented: boolean;
  /**
   * Says whether the page has much else to do. It then stays responsive while a frame is drawn, which comes a little
   * later.
   */
  setBusy(busy: boolean): void;
}

/** Names of software renderers: Chromium's, Mesa's, Windows' and macOS'. */
const SOFTWARE_RENDERERS = /swiftshader|llvmpipe|softpipe|basic render|software/i;

/** Whether WebGL is drawn by software, without a graphics card. */
export function isSoftwareRendered(): boolean {
  const gl = document.createElement('canvas').getContext('webgl2');
  const names = gl?.getExtension('WEBGL_debug_renderer_info');
  const name = names ? String(gl?.getParameter(names.UNMASKED_RENDERER_WEBGL)) : '';
  // Browsers allow few contexts; one that is not given back waits for the garbage collector.
  gl?.getExtension('WEBGL_lose_context')?.loseContext();
  return SOFTWARE_RENDERERS.test(name);
}

/** Presents the canvas itself: the browser brings its frames on the screen, which blocks nothing with a graphics card. */
export const createDirectPresenter = ({ domElement }: WebGLRenderer): FramePresenter => ({
  element: domElement,
  frameDone: () => undefined,
  presented: true,
  setBusy: () => undefined,
});

/** Time between two looks whether a frame is finished, milliseconds. */
const POLL_MS = 4;

/**
 * Presents the canvas itself or, while the page is busy, 2D copies of its frames, each made when the frame is finished.
 * With a software renderer the browser fetches a frame from a canvas in the middle of a task of the page, which is
 * blocked until the frame is drawn: beside other work that may take long. A copy costs a quarter of the frame rate, so
 * it is not made all the time. The last copy stays until the next frame after that: a picture that stands still needs
 * no drawing and blocks nothing.
 *
 * @param renderer one that preserves its drawing buffer
 * @param onPresented called when a copy is on the page
 */
export function createCopyPresenter(renderer: WebGLRenderer, onPresented: () => void): FramePresenter {
  const gl = renderer.getContext() as WebGL2RenderingContext;
  const canvas = renderer.domElement;
  const copy = document.createElement('canvas');
  copy.style.display = 'block';
  const context = copy.getContext('2d', { alpha: false, willReadFrequently: true });
  const element = document.createElement('div');
  element.append(canvas);
  let busyPage = false;
  let fence: WebGLSync | null = null;
  let timer: ReturnType<typeof setTimeout> | undefined;

  function cancel(): void {
    clearTimeout(timer);
    gl.deleteSync(fence);
    fence = null;
  }
  function poll(): void {
    if (fence === null) return;
    if (gl.getSyncParameter(fence, gl.SYNC_STATUS) !== gl.SIGNALED && !gl.isContextLost()) {
      timer = setTimeout(poll, POLL_MS);
      return;
    }
    cancel();
    drawCopy();
    // A canvas that is not on the page is not fetched for it.
    if (canvas.isConnected) canvas.replaceWith(copy);
    onPresented();
  }
  function drawCopy(): void {
    if (copy.width !== canvas.width) copy.width = canvas.width;
    if (copy.height !== canvas.height) copy.height = canvas.height;
    copy.style.width = canvas.style.width;
    copy.style.height = canvas.style.height;
    context?.drawImage(canvas, 0, 0);
  }
  function copyWhenFinished(): void {
    cancel();
    fence = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    gl.flush();
    timer = setTimeout(poll, POLL_MS);
  }
  return {
    element,
    frameDone() {
      if (busyPage) return copyWhenFinished();
      cancel();
      copy.replaceWith(canvas);
    },
    get presented() {
      return fence === null;
    },
    setBusy(busy) {
      if (busy === busyPage) return;
      busyPage = busy;
      // Copies the frame that is there: the next one must not be drawn on a canvas that is on the page.
      if (busy && canvas.isConnected) copyWhenFinished();
    },
  };
}
