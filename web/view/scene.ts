import { Color, Scene } from 'three';
import type { Couple } from './camera/framing';
import type { Viewport } from './canvas';
import { createContactShadows } from './contact-shadows';
import type { Dancers } from './dancer/dancers';
import { createFloor } from './floor';
import { createLights } from './lights';
import { createOverlays } from './overlays/overlays';
import type { Look } from './theme';

/** Everything that the stage draws: background, floor, contact shadows, lights, dancers and overlays. */
export class StageScene {
  readonly scene = new Scene();
  readonly overlays = createOverlays();
  private readonly background = new Color();
  private readonly floor = createFloor();
  private readonly contactShadows = createContactShadows();
  private readonly lights = createLights();

  constructor(readonly dancers: Dancers) {
    this.scene.background = this.background;
    for (const { object } of this.parts) this.scene.add(object);
  }

  setLook(look: Look): void {
    this.background.set(look.background);
    for (const part of this.parts) part.setLook(look);
  }

  /**
   * Moves floor and lights to the couple.
   *
   * @param heading direction from which the lights shine as for a camera there, radians about y
   */
  centreOn({ x, z }: Couple, heading: number): void {
    this.lights.place(x, z, heading);
    this.floor.setCentre(x, z);
  }

  /**
   * Shows the dancers of one viewport with their contact shadows and overlays.
   *
   * @param seconds moment of the dance, for overlays that depend on it
   * @returns number of dancers in it that overlays are drawn for
   */
  arrange(viewport: Viewport, seconds: number): number {
    const figures = this.dancers.arrange(viewport);
    this.contactShadows.update(figures);
    this.overlays.update(figures, seconds);
    return figures.length;
  }

  dispose(): void {
    for (const part of this.parts) part.dispose();
  }

  private get parts() {
    return [this.floor, this.contactShadows, this.lights, this.dancers, this.overlays];
  }
}
