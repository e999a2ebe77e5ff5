import { expect, type Locator, type Page } from '@playwright/test';
import type { AppState } from '../../../web/ui/store/state';
import type { TestFile } from './files';

/** Address of the app with the tiny model of the fixtures, on the processor. */
export const TINY = '/?model=/models/tiny/manifest.json&backend=wasm';

/** Address of the app with the model that ships with it, on the processor. */
export const SHIPPED = '/?backend=wasm';

/** Time that reading and generating may take on a busy machine. */
const TIMEOUT_MS = 120_000;

/** The page as a visitor uses it, through labels and roles; `window.reactdance` is only read, for results. */
export class App {
  readonly alert: Locator;
  readonly progress: Locator;

  constructor(readonly page: Page) {
    this.alert = page.getByRole('alertdialog');
    this.progress = page.getByRole('progressbar', { name: 'Generation' });
  }

  async open(address = TINY): Promise<void> {
    await this.page.goto(address);
    await expect(this.page.getByRole('heading', { name: 'ReactDance', exact: true })).toBeAttached();
    await expect(this.page.getByRole('region', { name: 'Timeline' })).toBeVisible();
  }

  /**
   * Opens the app as on a machine without WebGL and closes the dialog that reports it. Tests that do not need the
   * picture are faster without it.
   */
  async openWithoutPicture(address = TINY): Promise<void> {
    await this.page.addInitScript(() => {
      const canvas = HTMLCanvasElement.prototype;
      const getContext = Reflect.get(canvas, 'getContext') as (this: unknown, kind: string) => unknown;
      Reflect.set(canvas, 'getContext', function (this: unknown, kind: string) {
        return kind.startsWith('webgl') ? null : getContext.call(this, kind);
      });
    });
    await this.open(address);
    await expect(this.alert.getByRole('heading')).toHaveText(/WebGL/);
    await this.page.keyboard.press('Escape');
    await expect(this.alert.filter({ hasText: /WebGL/ })).toBeHidden();
  }

  /** Waits until model and demo are loaded or have failed, and no job is running. */
  async settled(): Promise<void> {
    await this.until(
      ({ model, demo, reading, job }) =>
        model.phase !== 'loading' && demo !== 'loading' && !reading.song && !reading.leader && !job,
    );
  }

  /** A part of the page's state. `select` runs in the page and sees nothing of the test but its argument. */
  async read<T, A = undefined>(select: (state: AppState, argument: A) => T, argument?: A): Promise<T> {
    // Evaluated as an expression: the content security policy forbids functions from strings.
    return this.page.evaluate<T>(
      `(${select.toString()})(window.reactdance.store.getState(), ${JSON.stringify(argument)})`,
    );
  }

  /**
   * Waits until the page has loaded its app and the state meets a condition. `is` runs in the page and sees nothing of
   * the test but its argument.
   */
  async until<A = undefined>(is: (state: AppState, argument: A) => unknown, argument?: A): Promise<void> {
    const options = { timeout: TIMEOUT_MS, intervals: [50, 100, 250], message: is.toString() };
    const expression = `Boolean(window.reactdance && (${is.toString()})(window.reactdance.store.getState(), ${JSON.stringify(argument)}))`;
    await expect.poll(() => this.page.evaluate<boolean>(expression), options).toBe(true);
  }

  /**
   * Chooses files through the button that asks for them.
   * @param file made here, or the path of one: the browser opens that itself, without a task of the page
   */
  async choose(button: 'Choose a song' | 'Choose a file' | RegExp, file: TestFile | string): Promise<void> {
    const chooser = this.page.waitForEvent('filechooser');
    await this.page.getByRole('button', { name: button }).first().click();
    await (await chooser).setFiles(file);
  }

  chooseSong = (file: TestFile | string): Promise<void> => this.choose(/^(Song: |No song yet)/, file);
  chooseLeader = (file: TestFile): Promise<void> => this.choose(/^(Leader: |No leader yet)/, file);

  /** Drops files anywhere on the page, all at once. */
  async drop(...files: TestFile[]): Promise<void> {
    const data = files.map(({ name, mimeType, buffer }) => ({
      name,
      mimeType,
      base64: buffer.toString('base64'),
    }));
    const transfer = await this.page.evaluateHandle((list) => {
      const carried = new DataTransfer();
      for (const { name, mimeType, base64 } of list) {
        const bytes = Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
        carried.items.add(new File([bytes], name, { type: mimeType }));
      }
      return carried;
    }, data);
    for (const type of ['dragenter', 'dragover', 'drop'])
      await this.page.dispatchEvent('body', type, { dataTransfer: transfer });
    // The page would hold the files for as long as it is open.
    await transfer.dispose();
  }

  /** Waits for the reaction to the leader of this name, made here. */
  async reaction(leader: string): Promise<void> {
    await this.until(
      ({ reaction, problem }, name) => problem || reaction?.inputs.leader.name === name,
      leader,
    );
    expect(await this.read(({ problem }) => problem)).toBeNull();
    await this.until(({ job }) => !job);
  }

  /**
   * Loops from the beat nearest to a frame to the beat nearest to another, by keys.
   *
   * @returns the loop, seconds
   */
  async drawLoop(from: number, to: number): Promise<{ readonly from: number; readonly to: number }> {
    for (const [frames, key] of [
      [from, 'i'],
      [to, 'o'],
    ] as const) {
      await this.page.keyboard.press('Home');
      for (let frame = 0; frame < frames; frame++) await this.page.keyboard.press('ArrowRight');
      await this.page.keyboard.press(key);
    }
    const region = await this.read(({ playback }) => playback.region);
    if (!region) throw new Error('There is no loop.');
    return region;
  }

  /** The reactor's joints, frames x 22 x 3 in metres. */
  async reactor(): Promise<number[]> {
    return this.read(({ reaction }) => Array.from(reaction?.motion.positions ?? []));
  }

  /** The joints that the stage draws right now, 22 x 3 in metres. */
  async onScreen(): Promise<number[]> {
    return this.page.evaluate<number[]>("Array.from(window.reactdance.stage.jointPositions('reactor'))");
  }

  /** Indices of the stage's pixels in warm colours, which only the reactor has. */
  async warmPixels(): Promise<Set<number>> {
    const png = await this.page.getByRole('img', { name: /reactor in orange/ }).screenshot();
    const warm = await this.page.evaluate(async (base64) => {
      const bytes = Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
      const image = await createImageBitmap(new Blob([bytes], { type: 'image/png' }));
      const context = new OffscreenCanvas(image.width, image.height).getContext('2d');
      if (!context) throw new Error('The browser has no 2D canvas.');
      context.drawImage(image, 0, 0);
      const { data } = context.getImageData(0, 0, image.width, image.height);
      const found: number[] = [];
      for (let i = 0; i < data.length; i += 4) {
        const [red = 0, green = 0, blue = 0] = [data[i], data[i + 1], data[i + 2]];
        if (red >= 90 && red >= 1.3 * green && green >= blue) found.push(i / 4);
      }
      return found;
    }, png.toString('base64'));
    return new Set(warm);
  }
}

/** Mean joint speed of a motion in m/s. */
export function meanSpeed(positions: readonly number[], fps = 30): number {
  let sum = 0;
  for (let i = 66; i < positions.length; i += 3)
    sum += Math.hypot(
      ...[0, 1, 2].map((axis) => (positions[i + axis] ?? 0) - (positions[i + axis - 66] ?? 0)),
    );
  return (sum / Math.max(1, (positions.length - 66) / 3)) * fps;
}

/** Largest distance between the joints of two motions or poses, metres. */
export const maxDistance = (a: readonly number[], b: readonly number[]): number =>
  Math.max(...distances(a, b));

/** Mean distance between the joints of two motions or poses, metres. */
export function meanDistance(a: readonly number[], b: readonly number[]): number {
  const all = distances(a, b);
  return all.reduce((sum, each) => sum + each, 0) / all.length;
}

function distances(a: readonly number[], b: readonly number[]): number[] {
  return Array.from({ length: Math.floor(a.length / 3) }, (_, i) =>
    Math.hypot(...[0, 1, 2].map((axis) => (a[3 * i + axis] ?? 0) - (b[3 * i + axis] ?? 0))),
  );
}
