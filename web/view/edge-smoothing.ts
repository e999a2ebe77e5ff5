import {
  type Camera,
  FramebufferTexture,
  LinearFilter,
  Mesh,
  OrthographicCamera,
  PlaneGeometry,
  Scene,
  ShaderMaterial,
  Vector2,
  Vector3,
  type WebGLRenderer,
} from 'three';

/** A rectangle in a picture from its lower left corner, in the unit of the picture's size. */
export interface Rect {
  readonly left: number;
  readonly bottom: number;
  readonly width: number;
  readonly height: number;
}

/** Smooths the edges in part of a picture that has been drawn without antialiasing. */
export interface EdgeSmoothing {
  /** @param rect in CSS pixels; the scissor rectangle stays there afterwards. */
  smooth(rect: Rect): void;
  dispose(): void;
}

const VERTEX = /* glsl */ `
void main() {
  gl_Position = vec4(position.xy, 0.0, 1.0);
}`;

// FXAA (Lottes 2009): most pixels are as bright as their neighbours and left as they are after five samples.
const FRAGMENT = /* glsl */ `
uniform sampler2D picture;
uniform vec2 pixel;

const float MIN_CONTRAST = 0.03;
const float MIN_RELATIVE_CONTRAST = 0.1;
const float MAX_SPAN = 6.0;

float brightness(vec3 colour) {
  return dot(colour, vec3(0.299, 0.587, 0.114));
}
vec3 at(vec2 offset) {
  return texture(picture, (gl_FragCoord.xy + offset) * pixel).rgb;
}
float corner(ivec2 offset) {
  return brightness(texelFetch(picture, ivec2(gl_FragCoord.xy) + offset, 0).rgb);
}

void main() {
  vec3 here = texelFetch(picture, ivec2(gl_FragCoord.xy), 0).rgb;
  float middle = brightness(here);
  float nw = corner(ivec2(-1, 1)), ne = corner(ivec2(1, 1)), sw = corner(ivec2(-1, -1)), se = corner(ivec2(1, -1));
  float darkest = min(middle, min(min(nw, ne), min(sw, se)));
  float lightest = max(middle, max(max(nw, ne), max(sw, se)));
  gl_FragColor = vec4(here, 1.0);
  if (lightest - darkest < max(MIN_CONTRAST, lightest * MIN_RELATIVE_CONTRAST)) return;

  vec2 along = vec2(nw + ne - sw - se, nw + sw - ne - se);
  float least = max((nw + ne + sw + se) / 32.0, 1.0 / 128.0);
  along = clamp(along / (min(abs(along.x), abs(along.y)) + least), -MAX_SPAN, MAX_SPAN);
  vec3 near = 0.5 * (at(along / -6.0) + at(along / 6.0));
  vec3 far = 0.5 * near + 0.25 * (at(along * -0.5) + at(along * 0.5));
  float mean = brightness(far);
  gl_FragColor.rgb = mean < darkest || mean > lightest ? near : far;
}`;

/**
 * Fast approximate antialiasing of the finished picture (FXAA, Lottes 2009). With a software renderer, four samples a
 * pixel take a third of all the time, and FXAA around the dancers a third of that.
 */
export function createEdgeSmoothing(renderer: WebGLRenderer): EdgeSmoothing {
  const uniforms = { picture: { value: null as FramebufferTexture | null }, pixel: { value: new Vector2() } };
  const material = new ShaderMaterial({
    uniforms,
    vertexShader: VERTEX,
    fragmentShader: FRAGMENT,
    depthTest: false,
    depthWrite: false,
  });
  const quad = new Mesh(new PlaneGeometry(2, 2), material);
  const scene = new Scene().add(quad);
  const camera = new OrthographicCamera(-1, 1, 1, -1, 0, 1);
  const size = new Vector2();
  const origin = new Vector2();
  let picture: FramebufferTexture | null = null;

  function textureOf(width: number, height: number): FramebufferTexture {
    if (picture?.image.width === width && picture.image.height === height) return picture;
    picture?.dispose();
    picture = new FramebufferTexture(width, height);
    picture.magFilter = LinearFilter;
    picture.minFilter = LinearFilter;
    uniforms.picture.value = picture;
    uniforms.pixel.value.set(1 / width, 1 / height);
    return picture;
  }

  return {
    smooth({ left, bottom, width, height }) {
      renderer.getDrawingBufferSize(size);
      renderer.copyFramebufferToTexture(textureOf(size.x, size.y), origin);
      renderer.getSize(size);
      renderer.setViewport(0, 0, size.x, size.y);
      renderer.setScissorTest(true);
      renderer.setScissor(left, bottom, width, height);
      const { autoClear } = renderer;
      renderer.autoClear = false;
      renderer.render(scene, camera);
      renderer.autoClear = autoClear;
    },
    dispose() {
      picture?.dispose();
      quad.geometry.dispose();
      material.dispose();
    },
  };
}

const point = new Vector3();

/**
 * Bounding rectangle of the dancers in a picture.
 *
 * @param joints world positions (x 3, metres), a list for each dancer
 * @param picture rectangle of the whole picture
 * @param margin around every joint, metres
 * @returns null when no dancer is in the picture
 */
export function screenBounds(
  joints: readonly Float32Array[],
  camera: Camera,
  picture: Rect,
  margin: number,
): Rect | null {
  const { elements } = camera.projectionMatrix;
  let [left, right, bottom, top] = [1, 0, 1, 0];
  for (const list of joints) {
    for (let at = 0; at < list.length; at += 3) {
      const { x, y, z } = point.fromArray(list, at).applyMatrix4(camera.matrixWorldInverse);
      const depth = Math.max(-z, margin);
      const across = 0.5 + (elements[0] * x + elements[8] * z) / depth / 2;
      const up = 0.5 + (elements[5] * y + elements[9] * z) / depth / 2;
      const [halfWidth, halfHeight] = [
        (elements[0] * margin) / depth / 2,
        (elements[5] * margin) / depth / 2,
      ];
      [left, right] = [Math.min(left, across - halfWidth), Math.max(right, across + halfWidth)];
      [bottom, top] = [Math.min(bottom, up - halfHeight), Math.max(top, up + halfHeight)];
    }
  }
  [left, bottom] = [Math.max(left, 0), Math.max(bottom, 0)];
  const [width, height] = [Math.min(right, 1) - left, Math.min(top, 1) - bottom];
  if (width <= 0 || height <= 0) return null;
  return {
    left: picture.left + left * picture.width,
    bottom: picture.bottom + bottom * picture.height,
    width: width * picture.width,
    height: height * picture.height,
  };
}
