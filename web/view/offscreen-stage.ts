import type { PictureSize } from '../common/picture';
import { Stage } from './stage';
import { AppError } from '../common/error';

/**
 * An empty stage off the page, for pictures of `size` pixels. It shares the bodies with `stage` and nothing that moves.
 *
 * @throws {AppError} `webgl-missing` when the browser gives no second context.
 */
export function createOffscreenStage(stage: Stage, size: PictureSize): OffscreenStage {
  return new OffscreenStage(document.createElement('div'), stage.library, stage.softwareRendered, size);
}

/** A stage that is never on the page and draws only when told to, for the pictures of a video. */
class OffscreenStage extends Stage {
  get canvas(): HTMLCanvasElement {
    return this.view.canvas.renderer.domElement;
  }

  /**
   * Draws the moment `seconds` now; `dt` seconds have passed since the picture before it.
   *
   * @throws {AppError} `webgl-lost` when the graphics card has taken the context away.
   */
  drawAt(seconds: number, dt: number): void {
    if (this.view.canvas.lost) {
      throw new AppError(
        'webgl-lost',
        'The graphics card stopped drawing the video.',
        'Try again, with a smaller picture or fewer other tabs open.',
      );
    }
    this.view.setTime(seconds);
    this.drawFrame(dt);
  }

  dispose(): void {
    this.view.dispose();
  }
}
