import { BufferAttribute, BufferGeometry, DynamicDrawUsage, Mesh, ShaderMaterial } from 'three';

/** Bands along curves that turn their face to the eye, in one mesh. */
export interface Ribbons {
  readonly object: Mesh;
  /** Forgets all bands. */
  clear(): void;
  /** Begins a band; points follow. Bands beyond the room made for them are left out. */
  begin(): void;
  /** A point of the band: place in metres, half width in metres, colour (linear, 0 to 1) and opacity. */
  point(x: number, y: number, z: number, width: number, colour: Rgb, opacity: number): void;
  /** Hands all bands to the graphics card. */
  commit(): void;
  dispose(): void;
}

export interface Rgb {
  readonly r: number;
  readonly g: number;
  readonly b: number;
}

const VERTEX = /* glsl */ `
attribute vec3 along;
attribute float across;
attribute vec4 paint;
varying vec4 vPaint;
void main() {
  vec4 eye = modelViewMatrix * vec4(position, 1.0);
  vec3 side = cross((modelViewMatrix * vec4(along, 0.0)).xyz, eye.xyz);
  eye.xyz += normalize(side + vec3(0.0, 1e-9, 0.0)) * across;
  vPaint = paint;
  gl_Position = projectionMatrix * eye;
}`;
const FRAGMENT = /* glsl */ `
varying vec4 vPaint;
void main() {
  gl_FragColor = vPaint;
  #include <colorspace_fragment>
}`;

/**
 * @param bands room for this many bands
 * @param points room for this many points in each
 * @param over drawn over the bodies instead of among them
 */
export function createRibbons(bands: number, points: number, over: boolean): Ribbons {
  const room = bands * points * 2;
  const attribute = (size: number): BufferAttribute =>
    new BufferAttribute(new Float32Array(room * size), size).setUsage(DynamicDrawUsage);
  const [position, along, across, paint] = [attribute(3), attribute(3), attribute(1), attribute(4)];
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', position).setAttribute('along', along);
  geometry.setAttribute('across', across).setAttribute('paint', paint);
  const index = new Uint16Array(bands * (points - 1) * 6);
  geometry.setIndex(new BufferAttribute(index, 1).setUsage(DynamicDrawUsage));
  const material = new ShaderMaterial({
    vertexShader: VERTEX,
    fragmentShader: FRAGMENT,
    transparent: true,
    depthWrite: false,
    depthTest: !over,
  });
  const object = new Mesh(geometry, material);
  object.frustumCulled = false;
  object.renderOrder = over ? 20 : 12;

  let band = -1;
  let used = 0;
  let corners = 0;
  /** The direction at a point is that to the next one; the last point has that of the one before. */
  const direct = (from: number, to: number): void => {
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
      band = -1;
      corners = 0;
    },
    begin() {
      band++;
      used = 0;
    },
    point(x, y, z, width, { r, g, b }, opacity) {
      if (band >= bands || used >= points) return;
      const at = band * points + used;
      for (const side of [0, 1]) {
        const vertex = at * 2 + side;
        position.setXYZ(vertex, x, y, z);
        across.setX(vertex, side === 0 ? width : -width);
        paint.setXYZW(vertex, r, g, b, opacity);
      }
      if (used > 0) {
        direct(at - 1, at);
        const [a, c] = [(at - 1) * 2, at * 2];
        index.set([a, a + 1, c, c, a + 1, c + 1], corners);
        corners += 6;
      }
      used++;
    },
    commit() {
      geometry.setDrawRange(0, corners);
      object.visible = corners > 0;
      for (const changed of [position, along, across, paint, geometry.index!]) changed.needsUpdate = true;
    },
    dispose() {
      geometry.dispose();
      material.dispose();
    },
  };
}
