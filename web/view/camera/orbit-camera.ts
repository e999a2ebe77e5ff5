import { PerspectiveCamera, Spherical, Vector3 } from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import type { Shot } from '../../common/framing';
import { FIELD_OF_VIEW, MAX_DISTANCE } from './framing';

const POLE = Math.PI / 2;
const UP = new Vector3(0, 1, 0);
/** Share of the picture's height that a couple leaves free at each edge, wherever it stands. */
const FREE_EDGE = 0.09;
/** How small a couple may become for controls, as a share of its usual size. */
const MIN_ZOOM = 0.5;

/** What lies over the picture, in CSS pixels. */
export interface Covered {
  /** By how much the couple moves to the right, beside what is on the left. */
  readonly left: number;
  /** Height of the controls along the upper and the lower edge. */
  readonly edges: number;
}

/** A perspective camera with orbit controls that is read and placed as a `Shot`. */
export class OrbitCamera {
  readonly camera = new PerspectiveCamera(FIELD_OF_VIEW, 1, 0.05, 80);
  readonly controls: OrbitControls;
  private size = { width: 1, height: 1 };
  private covered: Covered = { left: 0, edges: 0 };
  private readonly spherical = new Spherical();
  private readonly vector = new Vector3();

  /** @param surface element that takes the pointer; null without one */
  constructor(surface: HTMLElement | null) {
    this.controls = new OrbitControls(this.camera, surface);
    this.controls.dampingFactor = 0.12;
    this.controls.minDistance = 1.2;
    this.controls.maxDistance = MAX_DISTANCE;
    this.controls.maxPolarAngle = POLE + 0.06;
    this.controls.zoomSpeed = 0.8;
  }

  /** Width / height of the part of the picture around the couple. */
  get aspect(): number {
    const { width, height } = this.size;
    return (width - 2 * this.covered.left) / height;
  }

  get shot(): Shot {
    const { camera, controls, spherical } = this;
    spherical.setFromVector3(this.vector.copy(camera.position).sub(controls.target));
    return {
      target: [controls.target.x, controls.target.y, controls.target.z],
      distance: spherical.radius,
      heading: spherical.theta,
      elevation: POLE - spherical.phi,
    };
  }

  set shot({ target, distance, heading, elevation }: Shot) {
    const { camera, controls, spherical } = this;
    controls.target.set(...target);
    spherical.set(distance, POLE - elevation, heading);
    camera.position.setFromSpherical(spherical).add(controls.target);
    camera.lookAt(controls.target);
  }

  /** Moves eye and target along the floor, metres. */
  translate(x: number, z: number): void {
    this.vector.set(x, 0, z);
    this.controls.target.add(this.vector);
    this.camera.position.add(this.vector);
  }

  /** Turns eye and target by an angle about a vertical axis through a point. */
  turn(angle: number, about: Vector3): void {
    const { target } = this.controls;
    for (const point of [target, this.camera.position]) point.sub(about).applyAxisAngle(UP, angle).add(about);
    this.camera.lookAt(target);
  }

  resize(width: number, height: number): void {
    this.camera.aspect = width / height;
    this.size = { width, height };
    this.updateViewOffset();
  }

  /** Leaves room for what lies over the picture; in a low picture the couple is smaller for it. */
  leaveRoom(covered: Covered): void {
    this.covered = covered;
    this.updateViewOffset();
  }

  private updateViewOffset(): void {
    const { width, height } = this.size;
    const { left, edges } = this.covered;
    const between = (1 - (2 * edges) / height) / (1 - 2 * FREE_EDGE);
    this.camera.zoom = Math.max(MIN_ZOOM, Math.min(1, between));
    this.camera.setViewOffset(width, height, -left, 0, width, height);
  }
}
