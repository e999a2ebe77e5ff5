import { BufferAttribute, MeshLambertMaterial, SkinnedMesh } from 'three';
import type { SolvedMotion } from '../../../../web/motion/skeleton/clip';
import { J } from '../../../../web/motion/skeleton/skeleton';
import { toGeometry } from '../../../../web/view/body/geometry';
import { BUILDS } from '../../../../web/view/body/part';
import { type Body, makeBody } from '../../../../web/view/body/simplify';
import { createPose, samplePose } from '../../../../web/view/dancer/pose';
import { createRig, type Rig } from '../../../../web/view/dancer/rig';

type Colour = readonly [red: number, green: number, blue: number];

const SKIN: Colour = [0.72, 0.45, 0.32];
const HAIR: Colour = [0.05, 0.035, 0.03];
/** Colours of shirt and trousers. */
const OUTFITS = {
  red: { shirt: [0.55, 0.06, 0.06], trousers: [0.05, 0.07, 0.16] },
  green: { shirt: [0.1, 0.35, 0.2], trousers: [0.1, 0.35, 0.2] },
} as const satisfies Record<string, Readonly<Record<'shirt' | 'trousers', Colour>>>;
export type Outfit = keyof typeof OUTFITS;
const SHOES: Colour = [0.02, 0.02, 0.02];
const EYES: Colour = [0.03, 0.03, 0.04];

const HEAD: ReadonlySet<number> = new Set([J.head, J.neck]);
const BARE_ARMS: ReadonlySet<number> = new Set([J.left_elbow, J.right_elbow, J.left_wrist, J.right_wrist]);
const LEGS: ReadonlySet<number> = new Set([
  J.pelvis,
  J.left_hip,
  J.right_hip,
  J.left_knee,
  J.right_knee,
  J.left_ankle,
  J.right_ankle,
]);

export interface Mannequin {
  readonly mesh: SkinnedMesh;
  readonly rig: Rig;
  pose(seconds: number): void;
}

/**
 * Our own mannequin in motion.
 * @param outfit in the colours of a person: skin, hair, eyes, a shirt, trousers and shoes; null is grey-blue all over
 */
export async function createMannequin(motion: SolvedMotion, outfit: Outfit | null): Promise<Mannequin> {
  const body = await makeBody(motion.offsets, BUILDS.leader);
  const { near: geometry } = toGeometry(body);
  if (outfit) geometry.setAttribute('color', new BufferAttribute(clothes(body, outfit), 3));
  const material = new MeshLambertMaterial({ vertexColors: true, color: outfit ? 0xffffff : 0x4b9bd4 });
  const rig = createRig();
  rig.fit(motion.offsets);
  const mesh = new SkinnedMesh(geometry, material);
  mesh.frustumCulled = false;
  mesh.bind(rig.skeleton);
  // After the mesh's own binding, which takes the pose of the bones for that of the skin.
  rig.bind(body.offsets);
  const pose = createPose();
  return {
    mesh,
    rig,
    pose: (seconds) => {
      samplePose(motion, seconds, pose);
      rig.apply(pose);
    },
  };
}

/** A colour for every vertex, by the joint that moves it. */
function clothes({ positions, skinJoints, skinWeights }: Body, outfit: Outfit): Float32Array {
  const { shirt, trousers } = OUTFITS[outfit];
  const colours = new Float32Array(positions.length);
  const heads: number[] = [];
  for (let v = 0; v < positions.length / 3; v++) {
    let strongest = 0;
    for (let i = 1; i < 4; i++) if (skinWeights[4 * v + i]! > skinWeights[4 * v + strongest]!) strongest = i;
    const joint = skinJoints[4 * v + strongest]!;
    let colour: Colour = shirt;
    if (HEAD.has(joint) || BARE_ARMS.has(joint)) colour = SKIN;
    else if (LEGS.has(joint)) colour = trousers;
    else if (joint === J.left_foot || joint === J.right_foot) colour = SHOES;
    if (joint === J.head) heads.push(v);
    colours.set(colour, 3 * v);
  }
  paintHead(positions, heads, colours);
  return colours;
}

/** Hair over the crown and the back of the head, eyes and a mouth in front. */
function paintHead(positions: Float32Array, vertices: readonly number[], colours: Float32Array): void {
  const at = (v: number, axis: number): number => positions[3 * v + axis]!;
  const range = (axis: number): readonly [number, number] => [
    Math.min(...vertices.map((v) => at(v, axis))),
    Math.max(...vertices.map((v) => at(v, axis))),
  ];
  const [[, right], [low, high], [back, front]] = [range(0), range(1), range(2)];
  for (const v of vertices) {
    const up = (at(v, 1) - low) / (high - low);
    const ahead = (at(v, 2) - back) / (front - back);
    const aside = Math.abs(at(v, 0)) / right;
    if (up > 0.82 || (ahead < 0.55 && up > 0.3)) colours.set(HAIR, 3 * v);
    else if (ahead > 0.75 && up > 0.52 && up < 0.64 && aside > 0.2 && aside < 0.62) colours.set(EYES, 3 * v);
    else if (ahead > 0.75 && up > 0.2 && up < 0.28 && aside < 0.35) colours.set([0.5, 0.15, 0.14], 3 * v);
  }
}
