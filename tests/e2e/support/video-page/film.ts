/** Films our mannequin with a camera that is known, into a video file. */
import {
  BufferTarget,
  CanvasSource,
  Mp4OutputFormat,
  Output,
  QUALITY_HIGH,
  type Rotation,
  WebMOutputFormat,
} from 'mediabunny';
import {
  Color,
  DirectionalLight,
  GridHelper,
  HemisphereLight,
  Mesh,
  MeshLambertMaterial,
  PerspectiveCamera,
  PlaneGeometry,
  Scene,
  WebGLRenderer,
} from 'three';
import type { SolvedMotion } from '../../../../web/motion/skeleton/clip';
import { SOLE } from '../../../../web/motion/skeleton/kinematics';
import { createMannequin } from './mannequin';

/** A camera that stands still and looks at a point; metres, y up. */
export interface Shot {
  readonly width: number;
  readonly height: number;
  /** Focal length, pixels. */
  readonly focal: number;
  readonly position: readonly [number, number, number];
  readonly target: readonly [number, number, number];
  readonly fps: number;
  readonly clothed: boolean;
  /** Clockwise turn that players are told to apply to the pictures, degrees. */
  readonly rotation?: Rotation;
}

/** The dancers of a motion in the picture, each shifted along x by metres. */
export interface Cast {
  readonly motion: SolvedMotion;
  readonly aside?: number;
}

function studio(): Scene {
  const scene = new Scene();
  scene.background = new Color(0x9aa3a8);
  const sun = new DirectionalLight(0xffffff, 2);
  sun.position.set(2, 4, 3);
  scene.add(sun, new HemisphereLight(0xffffff, 0x8a8378, 1.6));
  const floor = new Mesh(new PlaneGeometry(14, 14), new MeshLambertMaterial({ color: 0xa98a64 }));
  floor.rotateX(-Math.PI / 2);
  const lines = new GridHelper(14, 28, 0x7a6348, 0x7a6348);
  // The soles of shoes are below the joints of the toes, which motions have on the floor.
  floor.position.y = lines.position.y = -SOLE;
  scene.add(floor, lines);
  return scene;
}

/** @returns a WebM file with VP8, the one codec that every Chromium encodes */
export async function film(cast: readonly Cast[], shot: Shot, seconds: number): Promise<Blob> {
  const renderer = new WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
  renderer.setPixelRatio(1);
  renderer.setSize(shot.width, shot.height);
  const scene = studio();
  const mannequins = await Promise.all(cast.map(({ motion }) => createMannequin(motion, shot.clothed)));
  mannequins.forEach(({ mesh, rig }, i) => {
    scene.add(mesh);
    mesh.add(rig.root);
    mesh.position.x = cast[i]?.aside ?? 0;
  });
  const fov = (2 * Math.atan(shot.height / 2 / shot.focal) * 180) / Math.PI;
  const camera = new PerspectiveCamera(fov, shot.width / shot.height, 0.1, 40);
  camera.position.set(...shot.position);
  camera.lookAt(...shot.target);
  const target = new BufferTarget();
  const rotated = shot.rotation !== undefined;
  const output = new Output({ format: rotated ? new Mp4OutputFormat() : new WebMOutputFormat(), target });
  const source = new CanvasSource(renderer.domElement, {
    codec: rotated ? 'vp9' : 'vp8',
    bitrate: QUALITY_HIGH,
    keyFrameInterval: 1,
  });
  output.addVideoTrack(source, { ...(rotated && { rotation: shot.rotation }) });
  await output.start();
  for (let frame = 0; frame < Math.round(seconds * shot.fps); frame++) {
    for (const mannequin of mannequins) mannequin.pose(frame / shot.fps);
    renderer.render(scene, camera);
    await source.add(frame / shot.fps, 1 / shot.fps);
  }
  await output.finalize();
  renderer.dispose();
  renderer.forceContextLoss();
  return new Blob([target.buffer!], { type: rotated ? 'video/mp4' : 'video/webm' });
}
