import { BufferAttribute, BufferGeometry, DynamicDrawUsage, Mesh, ShaderMaterial } from 'three';

/** Ribbons along curves that face the camera, in one mesh. */
interface Ribbons {
  readonly object: Mesh;
  /** Removes all ribbons. */
  clear(): void;
  /** Begins a ribbon; points follow. Ribbons and points beyond the capacity are left out. */
  begin(): void;
  /** Adds a point to the ribbon: position in metres, half width in metres, colour (linear, 0 to 1) and opacity. */
  point(x: number, y: number, z: number, width: number, colour: Rgb, opacity: number): void;
  /** Uploads all ribbons to the graphics card. */
  commit(): void;
  dispose(): void;
}

interface Rgb {
  readonly r: number;
  readonly g: number;
  readonly b: number;
}

const VERTEX = /* glsl */ `
attribute vec3 along;
attribute float across;
attribute vec4 rgba;
varying vec4 vRgba;
void main() {
  vec4 eye = modelViewMatrix * vec4(position, 1.0);
  vec3 side = cross((modelViewMatrix * vec4(along, 0.0)).xyz, eye.xyz);
  eye.xyz += normalize(side + vec3(0.0, 1e-9, 0.0)) * across;
  vRgba = rgba;
  gl_Position = projectionMatrix * eye;
}`;
const FRAGMENT = /* glsl */ `
varying vec4 vRgba;
void main() {
  gl_FragColor = vRgba;
  #include <colorspace_fragment>
}`;

/**
 * @param ribbons greatest number of ribbons
 * @param points greatest number of points in each
 * @param onTop drawn over the bodies instead of among them
 */
export function createRibbons(ribbons: number, points: number, onTop: boolean): Ribbons {
  const capacity = ribbons * points * 2;
  const attribute = (size: number): BufferAttribute =>
    new BufferAttribute(new Float32Array(capacity * size), size).setUsage(DynamicDrawUsage);
  const [position, along, across, rgba] = [attribute(3), attribute(3), attribute(1), attribute(4)];
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', position).setAttribute('along', along);
  geometry.setAttribute('across', across).setAttribute('rgba', rgba);
  const index = new Uint16Array(ribbons * (points - 1) * 6);
  geometry.setIndex(new BufferAttribute(index, 1).setUsage(DynamicDrawUsage));
  const material = new ShaderMaterial({
    vertexShader: VERTEX,
    fragmentShader: FRAGMENT,
    transparent: true,
    depthWrite: false,
    depthTest: !onTop,
  });
  const object = new Mesh(geometry, material);
  object.frustumCulled = false;
  object.renderOrder = onTop ? 20 : 12;

  let ribbon = -1;
  let used = 0;
  let corners = 0;
  /** The direction at a point is that to the next point; the last point has that of the point before. */
  const setDirection = (from: number, to: number): void => {
    for (let axis = 0; axis < 3; axis++) {
      const step = position.array[to * 6 + axis]! - position.array[from * 6 + axis]!;
      for (const side of [0, 3]) {
        along.array[from * 6 + side + axis] = step;
        along.array[to * 6 + side + axis] = step;
      }
    }
  };
  return {
    object,
    clear() {
      ribbon = -1;
      corners = 0;
    },
    begin() {
      ribbon++;
      used = 0;
    },
    point(x, y, z, width, { r, g, b }, opacity) {
      if (ribbon >= ribbons || used >= points) return;
      const at = ribbon * points + used;
      for (const side of [0, 1]) {
        const vertex = at * 2 + side;
        position.setXYZ(vertex, x, y, z);
        across.setX(vertex, side === 0 ? width : -width);
        rgba.setXYZW(vertex, r, g, b, opacity);
      }
      if (used > 0) {
        setDirection(at - 1, at);
        const [a, c] = [(at - 1) * 2, at * 2];
        index.set([a, a + 1, c, c, a + 1, c + 1], corners);
        corners += 6;
      }
      used++;
    },
    commit() {
      geometry.setDrawRange(0, corners);
      object.visible = corners > 0;
      for (const changed of [position, along, across, rgba, geometry.index!]) changed.needsUpdate = true;
    },
    dispose() {
      geometry.dispose();
      material.dispose();
    },
  };
}
