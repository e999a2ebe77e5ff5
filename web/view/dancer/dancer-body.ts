import type { Role } from '../../common/role';
import { BufferGeometry, Group, SkinnedMesh } from 'three';
import { toGeometry, type BodyGeometry } from '../body/geometry';
import type { Body } from '../body/simplify';
import type { Look } from '../theme';
import { createGhost, type Ghost, type GhostOpacity } from './ghost-material';
import type { BodyMaterial } from './body-material';
import type { Rig } from './rig';

/**
 * How a body is drawn: solid; see-through around the skeleton overlay's bones; as the ghost of the coarse layer; as the
 * ghost of another take.
 */
type BodyStyle = 'solid' | 'translucent' | 'coarse' | 'other';

const OPACITY: Readonly<Record<Exclude<BodyStyle, 'solid'>, GhostOpacity>> = {
  translucent: { facing: 0.14, grazing: 0.75 },
  coarse: { facing: 0.13, grazing: 0.85 },
  other: { facing: 0.24, grazing: 0.95 },
};

/** The skinned mesh on a dancer's bones, solid or as a ghost, in the colour of a role. */
export class DancerBody {
  readonly object = new Group();
  private readonly mesh: SkinnedMesh;
  private readonly ghost: Ghost;
  private geometry: BodyGeometry | null = null;
  private style: BodyStyle = 'solid';
  private look: Look | null = null;
  private lowDetail = false;
  private opacity = 1;

  /**
   * @param solid material of the solid body, disposed of with it
   * @param colours role whose colours the body has
   */
  constructor(
    private readonly rig: Rig,
    private readonly solid: BodyMaterial,
    private colours: Role,
  ) {
    this.mesh = new SkinnedMesh(new BufferGeometry(), solid.material);
    this.mesh.name = colours;
    this.mesh.castShadow = true;
    this.mesh.receiveShadow = true;
    // The bones carry the body across the floor, beyond the bounds of the bind pose.
    this.mesh.frustumCulled = false;
    this.mesh.bind(rig.skeleton);
    this.mesh.onBeforeShadow = () => this.geometry?.setLowDetail(true);
    this.mesh.onAfterShadow = () => this.geometry?.setLowDetail(this.lowDetail);
    this.ghost = createGhost(rig.skeleton);
  }

  /** Puts the mesh of a body on the bones. */
  setBody(body: Body): void {
    this.geometry?.dispose();
    this.geometry = toGeometry(body);
    this.geometry.setLowDetail(this.lowDetail);
    this.mesh.geometry = this.geometry.near;
    this.ghost.setGeometry(this.geometry.light);
    this.rig.bind(body.offsets);
    this.update();
  }

  setStyle(style: BodyStyle): void {
    if (style === this.style) return;
    this.style = style;
    this.update();
  }

  setColours(role: Role): void {
    if (role === this.colours) return;
    this.colours = role;
    this.update();
  }

  setLook(look: Look): void {
    this.look = look;
    this.update();
  }

  /** Sets the share of its opacity that a ghost has, 0 to 1. */
  setOpacity(share: number): void {
    if (share === this.opacity) return;
    this.opacity = share;
    this.update();
  }

  /** Draws the solid body with fewer triangles, for when it is small in the picture. */
  setLowDetail(on: boolean): void {
    if (on === this.lowDetail) return;
    this.lowDetail = on;
    this.geometry?.setLowDetail(on);
  }

  dispose(): void {
    this.geometry?.dispose();
    this.solid.material.dispose();
    this.ghost.dispose();
  }

  /** Colours the body and attaches the mesh of its style, once there is one. */
  private update(): void {
    const { style, colours, look, opacity } = this;
    if (look !== null) {
      this.solid.setTint(look[colours]);
      // Coarse layer and other take have ghost colours of their own when they are the reactor's.
      const own = style === 'coarse' || style === 'other' ? style : null;
      if (style !== 'solid') {
        const { facing, grazing } = OPACITY[style];
        this.ghost.setTint(look[own !== null && colours === 'reactor' ? own : colours], {
          facing: facing * opacity,
          grazing: grazing * opacity,
        });
      }
    }
    this.ghost.setShadow(style === 'translucent');
    if (this.geometry === null) return;
    this.object.clear();
    this.object.add(style === 'solid' ? this.mesh : this.ghost.object);
  }
}
