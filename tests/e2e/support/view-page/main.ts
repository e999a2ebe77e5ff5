/** Pictures drawn with single parts of the stage, for browser tests to compare. */
import type { Theme } from '../../../../web/common/picture';
import {
  Mesh,
  MeshBasicMaterial,
  PerspectiveCamera,
  PlaneGeometry,
  Scene,
  SkinnedMesh,
  VSMShadowMap,
  WebGLRenderer,
} from 'three';
import { toGeometry } from '../../../../web/view/body/geometry';
import { makeBody } from '../../../../web/view/body/simplify';
import { BUILDS } from '../../../../web/view/body/part';
import { createEdgeSmoothing } from '../../../../web/view/edge-smoothing';
import { createLights } from '../../../../web/view/lights';
import {
  perVertexMaterial,
  perPixelMaterial,
  type BodyMaterial,
} from '../../../../web/view/dancer/body-material';
import { createRig } from '../../../../web/view/dancer/rig';
import { LOOKS } from '../../../../web/view/theme';
import { person } from '../../../web/support/skeletons';

const SIDE = 360;

/** RGB of a picture, from its lower left corner. */
type Picture = readonly (readonly [red: number, green: number, blue: number])[];

function read(renderer: WebGLRenderer): Picture {
  const gl = renderer.getContext();
  const data = new Uint8Array(SIDE * SIDE * 4);
  gl.readPixels(0, 0, SIDE, SIDE, gl.RGBA, gl.UNSIGNED_BYTE, data);
  return Array.from({ length: SIDE * SIDE }, (_, i) => [data[i * 4]!, data[i * 4 + 1]!, data[i * 4 + 2]!]);
}

function rendererOf(antialias: boolean): WebGLRenderer {
  const renderer = new WebGLRenderer({ antialias, preserveDrawingBuffer: true });
  renderer.setPixelRatio(1);
  renderer.setSize(SIDE, SIDE);
  return renderer;
}

/** One body in the stage's lights, with an arm raised so that it casts a shadow on the trunk. */
async function drawBody(material: BodyMaterial, theme: Theme): Promise<Picture> {
  const renderer = rendererOf(true);
  renderer.shadowMap.enabled = true;
  renderer.shadowMap.type = VSMShadowMap;
  const offsets = person();
  const geometry = toGeometry(await makeBody(offsets, BUILDS.leader));
  const rig = createRig();
  rig.fit(offsets);
  rig.bind(offsets);
  const mesh = new SkinnedMesh(geometry.near, material.material);
  mesh.castShadow = mesh.receiveShadow = true;
  mesh.frustumCulled = false;
  mesh.bind(rig.skeleton);
  rig.skeleton.bones[16]!.rotateY(-1);
  rig.root.position.y = 0.95;
  const lights = createLights();
  lights.setLook(LOOKS[theme]);
  lights.place(0, 0, 0);
  material.setTint(LOOKS[theme].leader);
  const scene = new Scene().add(mesh, rig.root, lights.object);
  const camera = new PerspectiveCamera(30, 1, 0.1, 20);
  camera.position.set(0, 1, 3.6);
  camera.lookAt(0, 0.95, 0);
  renderer.render(scene, camera);
  const picture = read(renderer);
  renderer.dispose();
  renderer.forceContextLoss();
  return picture;
}

/** Greatest difference of two colours in a channel. */
const difference = (a: readonly number[], b: readonly number[]): number =>
  Math.max(...a.map((value, i) => Math.abs(value - b[i]!)));
const ascending = (values: number[]): number[] => values.sort((a, b) => a - b);
const quantile = (sorted: readonly number[], part: number): number =>
  sorted[Math.floor(part * sorted.length)]!;

// Pictures are compared in the page: passing one to a test takes long.
const page = {
  /** Differences between a body with lighting per vertex and per pixel, of 255. */
  async materials(theme: Theme): Promise<{ pixels: number; mean: number; most: number; contrast: number }> {
    const [pixel, corner] = [
      await drawBody(perPixelMaterial(), theme),
      await drawBody(perVertexMaterial(), theme),
    ];
    const body = pixel.flatMap((value, i) => (difference(value, [0, 0, 0]) > 8 ? [i] : []));
    const differences = ascending(body.map((i) => difference(pixel[i]!, corner[i]!)));
    const blues = ascending(body.map((i) => pixel[i]![2]));
    return {
      pixels: body.length,
      mean: differences.reduce((sum, value) => sum + value, 0) / differences.length,
      most: quantile(differences, 0.95),
      contrast: quantile(blues, 0.95) - quantile(blues, 0.05),
    };
  },

  /**
   * A white square on black, turned by `angle` radians, with its edges smoothed in the left half of the picture: counts
   * of pixels, and the difference of the left half from four samples a pixel, before and after.
   */
  edges(angle: number): {
    drawnGrey: number;
    leftGrey: number;
    rightGrey: number;
    inside: number;
    insideChanged: number;
    stepped: number;
    smooth: number;
  } {
    const square = new Mesh(new PlaneGeometry(1.2, 1.2), new MeshBasicMaterial({ color: 0xffffff }));
    square.rotation.z = angle;
    const scene = new Scene().add(square);
    const camera = new PerspectiveCamera(30, 1, 0.1, 20);
    camera.position.z = 4;
    const sampled = rendererOf(true);
    sampled.render(scene, camera);
    const wanted = read(sampled);
    sampled.forceContextLoss();
    const renderer = rendererOf(false);
    renderer.render(scene, camera);
    const drawn = read(renderer);
    createEdgeSmoothing(renderer).smooth({ left: 0, bottom: 0, width: SIDE / 2, height: SIDE });
    const smoothed = read(renderer);
    renderer.forceContextLoss();
    const grey = (picture: Picture): number[] =>
      picture.flatMap(([red], i) => (red > 16 && red < 239 ? [i] : []));
    const left = (i: number): boolean => i % SIDE < SIDE / 2;
    const around = [-1, 0, 1].flatMap((across) => [-SIDE, 0, SIDE].map((up) => across + up));
    const inside = drawn.flatMap((value, i) =>
      around.every((step) => difference(drawn[i + step] ?? value, value) === 0) ? [i] : [],
    );
    const off = (picture: Picture): number =>
      picture.reduce((sum, value, i) => sum + (left(i) ? difference(value, wanted[i]!) : 0), 0);
    return {
      drawnGrey: grey(drawn).length,
      leftGrey: grey(smoothed).filter(left).length,
      rightGrey: grey(smoothed).filter((i) => !left(i)).length,
      inside: inside.length / drawn.length,
      insideChanged: inside.filter((i) => difference(smoothed[i]!, drawn[i]!) > 0).length,
      stepped: off(drawn),
      smooth: off(smoothed),
    };
  },
};

export type Page = typeof page;
Object.assign(globalThis, { view: page });
