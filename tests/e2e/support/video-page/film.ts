/** Films our mannequin with a camera that is known, into a video file. */
import {
  AudioBufferSource,
  BufferTarget,
  CanvasSource,
  MovOutputFormat,
  Mp4OutputFormat,
  Output,
  QUALITY_HIGH,
  type Rotation,
  WebMOutputFormat,
} from 'mediabunny';
import {
  Color,
  DirectionalLight,
  Euler,
  GridHelper,
  Group,
  HemisphereLight,
  Mesh,
  MeshLambertMaterial,
  PerspectiveCamera,
  PlaneGeometry,
  Quaternion,
  Scene,
  WebGLRenderer,
} from 'three';
import type { SolvedMotion } from '../../../../web/motion/skeleton/clip';
import { SOLE } from '../../../../web/motion/skeleton/kinematics';
import type { Shot } from '../../../web/support/filmed/shots';
import { createMannequin, type Outfit } from './mannequin';

/**
 * A dancer in the picture, shifted along x and backwards by metres, and along x by `passing` metres more every second, who
 * is there from and until a time in seconds.
 */
export interface Cast {
  readonly motion: SolvedMotion;
  readonly aside?: number;
  readonly away?: number;
  readonly passing?: number;
  readonly outfit?: Outfit;
  readonly from?: number;
  readonly until?: number;
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

/** How a video is written. */
export interface VideoFormat {
  readonly container: 'webm' | 'mp4' | 'mov';
  /** Whether pictures come at uneven times, as phones write them. */
  readonly uneven?: boolean;
  /** Whether a knock is heard every half second. */
  readonly sound?: boolean;
  /** Time of the first picture, seconds; the sound begins at 0. What is before 0 is cut off in MP4, and still there. */
  readonly begin?: number;
}

const CONTAINERS = {
  webm: () => new WebMOutputFormat(),
  mp4: () => new Mp4OutputFormat(),
  mov: () => new MovOutputFormat(),
};

/** Writes the pictures of a canvas, drawn one after the other by `draw`, into a file with VP9, or WebM with VP8. */
export async function written(
  canvas: HTMLCanvasElement,
  draw: (seconds: number) => void,
  {
    fps,
    seconds,
    rotation,
    bitrate,
  }: {
    readonly fps: number;
    readonly seconds: number;
    readonly rotation?: Rotation;
    readonly bitrate?: number;
  },
  { container, uneven = false, sound = false, begin = 0 }: VideoFormat,
): Promise<Blob> {
  const target = new BufferTarget();
  const output = new Output({ format: CONTAINERS[container](), target });
  const source = new CanvasSource(canvas, {
    codec: container === 'webm' ? 'vp8' : 'vp9',
    bitrate: bitrate ?? QUALITY_HIGH,
    keyFrameInterval: 1,
  });
  output.addVideoTrack(source, { ...(rotation !== undefined && { rotation }) });
  const knocks = new AudioBufferSource({ codec: 'opus', bitrate: 64_000 });
  if (sound) output.addAudioTrack(knocks);
  await output.start();
  if (sound) await knocks.add(knocking(begin + seconds));
  const frames = Math.round(seconds * fps);
  const moment = (frame: number): number =>
    (frame + (uneven && frame > 0 && frame < frames ? 0.4 * Math.sin(1.7 * frame) : 0)) / fps;
  for (let frame = 0; frame < frames; frame++) {
    draw(moment(frame));
    await source.add(begin + moment(frame), moment(frame + 1) - moment(frame));
  }
  await output.finalize();
  return new Blob([target.buffer!], { type: `video/${container === 'mov' ? 'quicktime' : container}` });
}

/** A sound that knocks every half second. */
function knocking(seconds: number): AudioBuffer {
  const [sampleRate, spacing] = [48_000, 24_000];
  const buffer = new AudioBuffer({ length: Math.round(seconds * sampleRate), sampleRate });
  const samples = buffer.getChannelData(0);
  samples.forEach((_, i) => {
    const since = (i % spacing) / sampleRate;
    samples[i] = 0.8 * Math.exp(-40 * since) * Math.sin(2 * Math.PI * 220 * since);
  });
  return buffer;
}

/** A wall with things on it behind the dancer: of what stands still is seen how a camera turns. */
function wall(): Group {
  const group = new Group();
  const add = (x: number, y: number, width: number, height: number, color: number, z = -4): void => {
    const mesh = new Mesh(new PlaneGeometry(width, height), new MeshLambertMaterial({ color }));
    mesh.position.set(x, y, z);
    group.add(mesh);
  };
  add(0, 1.5, 16, 3.2, 0xb9b2a4, -4.05);
  for (const [x, y, width, height, color] of WALL) add(x, y, width, height, color);
  return group;
}

/** Doors, windows and pictures: middle, size in metres, colour. */
const WALL = [
  [-5.6, 1, 0.9, 2, 0x6b4f3a],
  [-4.1, 1.7, 1.2, 0.8, 0xdfe8ef],
  [-2.6, 1.6, 0.5, 0.7, 0x3f5d4a],
  [-1.7, 1.9, 0.3, 0.3, 0x8c3a2e],
  [-0.4, 1.6, 1, 0.6, 0x2f3e57],
  [1.1, 1.8, 0.6, 0.9, 0xd3c27a],
  [2.2, 1.4, 0.4, 0.4, 0x4a4a4a],
  [3.4, 1.7, 1.2, 0.8, 0xdfe8ef],
  [5, 1, 0.9, 2, 0x6b4f3a],
  [-3.2, 0.4, 1.6, 0.8, 0x7d6a55],
  [4.1, 0.3, 0.7, 0.6, 0x55606e],
] as const;

/** How a hand turns a camera that follows a dancer, to both sides by degrees. */
function heldTurn(panned: number, time: number): Quaternion {
  const degree = Math.PI / 180;
  const wave = (hertz: number, phase: number): number => Math.sin(2 * Math.PI * hertz * time + phase);
  return new Quaternion().setFromEuler(
    new Euler(
      degree * (1.5 * wave(0.4, 1) + 0.4 * wave(2.1, 0)),
      degree * (panned * wave(0.25, 0) + 0.4 * wave(1.7, 2)),
      degree * (0.8 * wave(0.5, 2) + 0.3 * wave(2.4, 1)),
    ),
  );
}

/** Films dancers. */
export async function film(
  cast: readonly Cast[],
  shot: Shot,
  seconds: number,
  format: VideoFormat = { container: 'webm' },
): Promise<Blob> {
  const renderer = new WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
  renderer.setPixelRatio(1);
  renderer.setSize(shot.width, shot.height);
  const scene = studio();
  const mannequins = await Promise.all(
    cast.map(({ motion, outfit = 'red' }) => createMannequin(motion, shot.clothed ? outfit : null)),
  );
  mannequins.forEach(({ mesh, rig }) => {
    scene.add(mesh);
    mesh.add(rig.root);
  });
  const fov = (2 * Math.atan(shot.height / 2 / shot.focal) * 180) / Math.PI;
  const camera = new PerspectiveCamera(fov, shot.width / shot.height, 0.1, 40);
  if (shot.panned !== undefined || shot.cut) scene.add(wall());
  const draw = (time: number): void => {
    const { position, target } = shot.cut && time >= shot.cut.at ? shot.cut : shot;
    camera.position.set(...position);
    camera.lookAt(...target);
    // A phone that is turned writes turned pictures and says by how much players have to turn them back.
    if (shot.rotation !== undefined) camera.rotateZ((-shot.rotation * Math.PI) / 180);
    if (shot.panned !== undefined) camera.quaternion.multiply(heldTurn(shot.panned, time));
    mannequins.forEach((mannequin, i) => {
      mannequin.pose(time);
      const { aside = 0, away = 0, passing = 0, from = 0, until = Infinity } = cast[i]!;
      mannequin.mesh.position.set(aside + passing * time, 0, -away);
      mannequin.mesh.visible = time >= from && time < until;
    });
    renderer.render(scene, camera);
  };
  const file = await written(renderer.domElement, draw, { ...shot, seconds }, format);
  renderer.dispose();
  renderer.forceContextLoss();
  return file;
}
