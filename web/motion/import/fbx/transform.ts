import { Matrix4, Quaternion, Vector3 } from 'three';
import { vectorOf, type Model } from './scene';
import { aboutAxis, conjugate, multiply, type Quat, rotate } from '../../math/quat';
import { add, sub, type Vec3, X_AXIS, Y_AXIS, Z_AXIS, ZERO } from '../../math/vec3';

const AXES = [X_AXIS, Y_AXIS, Z_AXIS] as const;
/** Orders of rotation by number: the axis that turns first comes first. */
const ORDERS = [
  [0, 1, 2],
  [0, 2, 1],
  [1, 2, 0],
  [1, 0, 2],
  [2, 0, 1],
  [2, 1, 0],
] as const;
const ONE: Vec3 = [1, 1, 1];

/** Angles in degrees about x, y and z as a rotation. */
function fromEuler(angles: Vec3, order: readonly number[] = ORDERS[0]): Quat {
  const [a, b, c] = order.map((axis) => aboutAxis(AXES[axis]!, (angles[axis]! * Math.PI) / 180)) as [
    Quat,
    Quat,
    Quat,
  ];
  return multiply(c, multiply(b, a));
}

/** Translation and rotation of a model from its parent, without its scale. */
export interface LocalTransform {
  readonly place: Vec3;
  readonly turn: Quat;
}

/**
 * How a model takes on what scales its parent: before its own rotation, after it, or without the parent's own scale, as
 * joints of Maya that compensate it.
 */
type Inheritance = 'before' | 'after' | 'compensated';

/** By FBX's number: RrSs, RSrs and Rrs. */
const INHERITANCES: readonly Inheritance[] = ['after', 'before', 'compensated'];

/** Fixed parts of a model's transform. */
export interface Rig {
  readonly translation: Vec3;
  readonly rotation: Vec3;
  readonly scale: Vec3;
  readonly inheritance: Inheritance;
  /** Transform for given animated values. */
  readonly local: (translation: Vec3, rotation: Vec3, scale: Vec3) => LocalTransform;
}

/**
 * A model's transform from its parent, as the FBX SDK composes it: T Roff Rp Rpre R Rpost⁻¹ Rp⁻¹ Soff Sp S Sp⁻¹, of which
 * the scale S acts on what hangs on the model and is handed to it by the caller.
 */
export function rigOf({ properties }: Model): Rig {
  const vector = (name: string, fallback = ZERO): Vec3 => vectorOf(properties, name, fallback);
  // Without RotationActive the order and the pre- and post-rotation are switched off.
  const active = properties.get('RotationActive')?.[0];
  const inactive = active === 0 || active === 'F';
  const number = Number(properties.get('RotationOrder')?.[0] ?? 0);
  const order = ORDERS[inactive ? 0 : number] ?? ORDERS[0];
  const before = inactive ? ZERO : vector('PreRotation');
  const after = inactive ? ZERO : vector('PostRotation');
  const [pre, post] = [fromEuler(before), conjugate(fromEuler(after))];
  const [offset, pivot] = [vector('RotationOffset'), vector('RotationPivot')];
  const [scaleOffset, scalePivot] = [vector('ScalingOffset'), vector('ScalingPivot')];
  const local = (translation: Vec3, rotation: Vec3, size: Vec3): LocalTransform => {
    const turn = multiply(multiply(pre, fromEuler(rotation, order)), post);
    const scaled: Vec3 = [scalePivot[0] * size[0], scalePivot[1] * size[1], scalePivot[2] * size[2]];
    const inner = add(sub(ZERO, pivot), add(scaleOffset, sub(scalePivot, scaled)));
    return { place: add(add(translation, offset), add(pivot, rotate(turn, inner))), turn };
  };
  return {
    translation: vector('Lcl Translation'),
    rotation: vector('Lcl Rotation'),
    scale: vector('Lcl Scaling', ONE),
    inheritance: INHERITANCES[Number(properties.get('InheritType')?.[0] ?? 0)] ?? 'after',
    local,
  };
}

/**
 * What scales, mirrors or shears a model, in the axes that all rotations above it and its own give it: its transform in the
 * world is these rotations after it.
 */
export interface Stretch {
  /** What comes from above. */
  readonly inherited: Matrix4;
  /** The same with the model's own scale, for what hangs on it. */
  readonly whole: Matrix4;
}

const UNSTRETCHED: Stretch = { inherited: new Matrix4(), whole: new Matrix4() };

/** The place of what hangs on a model, in the axes of that model. */
export function placeWithin({ whole }: Stretch, place: Vec3): Vec3 {
  return new Vector3(...place).applyMatrix4(whole).toArray();
}

/**
 * The stretch of a model that hangs on `above`, which is null for none, as the FBX SDK composes it; the axes of a mirror
 * turn what hangs on it, as there. Compensated is as in Maya: only the parent's own scale is taken out.
 *
 * @param turn the model's rotation from its parent
 */
export function stretchOf(above: Stretch | null, turn: Quat, size: Vec3, inheritance: Inheritance): Stretch {
  const { inherited: outer, whole: all } = above ?? UNSTRETCHED;
  const rotation = new Matrix4().makeRotationFromQuaternion(new Quaternion(...turn));
  const from = inheritance === 'compensated' ? outer : all;
  // Only the lengths of the axes act after the rotation; their directions, as of a mirror, come before it.
  const lengths = new Vector3(...ONE);
  if (inheritance === 'after') lengths.setFromMatrixScale(from);
  const [x, y, z] = lengths.toArray().map((length) => (length > 0 ? 1 / length : 1)) as [
    number,
    number,
    number,
  ];
  const inherited = rotation
    .clone()
    .transpose()
    .multiply(from)
    .scale(new Vector3(x, y, z))
    .multiply(rotation)
    .scale(lengths);
  return { inherited, whole: inherited.clone().scale(new Vector3(...size)) };
}
