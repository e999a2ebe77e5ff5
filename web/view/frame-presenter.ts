import type { WebGLRenderer } from 'three';

/** Where a renderer's pictures come on the page. */
export interface Sheet {
  /** What is on the page and takes the pointer. */
  readonly element: HTMLElement;
  /** Says that all of a picture has been asked of the renderer. */
  drawn(): void;
  /** Whether the last picture is on the page or comes by itself. */
  shown(): boolean;
  /**
   * Whether the page stays free while a picture is drawn; it comes a little later then. True when the next picture has
   * to be drawn at once: what is on the page may be empty.
   */
  setPatient(patient: boolean): boolean;
  dispose(): void;
}

/** Names of drawing without a graphics card: Chromium's, Mesa's, Windows' and macOS'. */
const BY_PROCESSOR = /swiftshader|llvmpipe|softpipe|basic render|software/i;

/** Whether the processor draws in place of a graphics card. */
export function drawnByProcessor(): boolean {
  const gl = document.createElement('canvas').getContext('webgl2');
  const names = gl?.getExtension('WEBGL_debug_renderer_info');
  const name = names ? String(gl?.getParameter(names.UNMASKED_RENDERER_WEBGL)) : '';
  // Browsers allow few contexts; one that is not given back waits for the garbage collector.
  gl?.getExtension('WEBGL_lose_context')?.loseContext();
  return BY_PROCESSOR.test(name);
}

/** The canvas itself: the browser brings its pictures on the screen, which with a graphics card holds nothing up. */
export const plainSheet = ({ domElement }: WebGLRenderer): Sheet => ({
  element: domElement,
  drawn: () => undefined,
  shown: () => true,
  setPatient: () => false,
  dispose: () => undefined,
});

/** From one look whether a picture is done to the next, milliseconds. */
const LOOK = 4;

/**
 * The canvas, or, while patient, copies of its pictures, each made when it is done. Where the processor draws, the
 * browser fetches a picture from a canvas in the middle of a task of the page, and the page stands still until it is
 * drawn: next to other work that may be long. A copy costs a quarter of the pictures, so it is not made all the time.
 *
 * @param renderer one whose canvas keeps its picture
 * @param onShown called when a copy is on the page
 */
export function copySheet(renderer: WebGLRenderer, onShown: () => void): Sheet {
  const gl = renderer.getContext() as WebGL2RenderingContext;
  const canvas = renderer.domElement;
  const copy = document.createElement('canvas');
  copy.style.display = 'block';
  const context = copy.getContext('2d', { alpha: false, willReadFrequently: true });
  const element = document.createElement('div');
  element.append(canvas);
  let patient = false;
  let pending: WebGLSync | null = null;
  let timer: ReturnType<typeof setTimeout> | undefined;

  function forget(): void {
    clearTimeout(timer);
    gl.deleteSync(pending);
    pending = null;
  }
  function look(): void {
    if (pending === null) return;
    if (gl.getSyncParameter(pending, gl.SYNC_STATUS) !== gl.SIGNALED && !gl.isContextLost()) {
      timer = setTimeout(look, LOOK);
      return;
    }
    forget();
    if (copy.width !== canvas.width) copy.width = canvas.width;
    if (copy.height !== canvas.height) copy.height = canvas.height;
    copy.style.width = canvas.style.width;
    copy.style.height = canvas.style.height;
    context?.drawImage(canvas, 0, 0);
    // What is not on the page is not fetched for it.
    if (canvas.isConnected) canvas.replaceWith(copy);
    onShown();
  }
  function copyWhenDone(): void {
    forget();
    pending = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    gl.flush();
    timer = setTimeout(look, LOOK);
  }
  return {
    element,
    drawn() {
      if (patient) copyWhenDone();
    },
    shown: () => pending === null,
    setPatient(next) {
      if (next === patient) return false;
      patient = next;
      if (patient) {
        // The picture that is there: the next one is not to be drawn on a canvas that is on the page.
        copyWhenDone();
        return false;
      }
      forget();
      copy.replaceWith(canvas);
      return true;
    },
    dispose: forget,
  };
}
