import { arrayOf, childOf, damagedFbx, type FbxNode, type FbxValue } from './node';
import type { Vec3 } from '../../math/vec3';

/** A joint or other object that moves. */
export interface Model {
  readonly id: string;
  readonly name: string;
  /** LimbNode, Root, Null or Mesh. */
  readonly type: string;
  readonly properties: ReadonlyMap<string, readonly FbxValue[]>;
}

/** Values over time in ticks. */
export interface Curve {
  readonly times: Float64Array;
  readonly values: Float64Array;
}

/** Curves of one property of a model: by axis, X, Y, Z. */
export interface Channel {
  readonly model: string;
  /** Lcl Translation, Lcl Rotation or Lcl Scaling. */
  readonly property: string;
  readonly curves: readonly (Curve | null)[];
}

export interface Clip {
  readonly name: string;
  readonly channels: readonly Channel[];
  /** Sentences about what was left out. */
  readonly warnings: readonly string[];
}

/** A part of a clip, which programs add to the others or put in their place. */
type Layer = Pick<Clip, 'name' | 'channels'>;

/** The hierarchy and the animation of a file. */
export interface FbxScene {
  readonly models: ReadonlyMap<string, Model>;
  /** Id of the model above each; those without one are not in it. */
  readonly parents: ReadonlyMap<string, string>;
  readonly clips: readonly Clip[];
  readonly settings: ReadonlyMap<string, readonly FbxValue[]>;
}

/** The values of a node's properties, each of which is a name, three words about its type, and the values. */
function propertiesOf(node: FbxNode | undefined): Map<string, readonly FbxValue[]> {
  return new Map(
    (childOf(node, 'Properties70')?.children ?? []).flatMap(({ values }) =>
      typeof values[0] === 'string' ? [[values[0], values.slice(4)] as const] : [],
    ),
  );
}

/** A property of three numbers. */
export function vectorOf(
  properties: ReadonlyMap<string, readonly FbxValue[]>,
  name: string,
  fallback: Vec3,
): Vec3 {
  const values = properties.get(name)?.slice(0, 3).map(Number);
  return values?.length === 3 && values.every(Number.isFinite) ? (values as unknown as Vec3) : fallback;
}

/** The name without its class: "Model::Hips" in text, "Hips\0\1Model" in binary. */
function plainName(value: FbxValue | undefined): string {
  return String(value ?? '')
    .split('\0')[0]!
    .replace(/^\w+::/, '');
}

/** An object with its id. */
interface Entry {
  readonly id: string;
  readonly node: FbxNode;
  readonly name: string;
}

const entryOf = (node: FbxNode): Entry => {
  const [id, name] = node.values;
  return { id: String(id), node, name: plainName(name) };
};

interface Link {
  readonly child: string;
  readonly parent: string;
  /** What the child gives its value to; empty where it hangs on the parent. */
  readonly property: string;
}

function linksOf(connections: FbxNode | undefined): Link[] {
  return (connections?.children ?? []).map(({ values: [, child, parent, property] }) => ({
    child: String(child),
    parent: String(parent),
    property: typeof property === 'string' ? property : '',
  }));
}

/** The property of a curve: `d|X`, `d|Y` or `d|Z`. */
const axisOf = (property: string): number => 'XYZ'.indexOf(property.at(-1) ?? '?');

function curveOf({ node }: Entry): Curve {
  const [times, values] = [arrayOf(node, 'KeyTime'), arrayOf(node, 'KeyValueFloat')];
  if (times.length !== values.length || !values.every(Number.isFinite) || !times.every(Number.isFinite))
    throw damagedFbx('the keys of a curve have no values');
  return { times, values };
}

/** Children by parent, over all links. */
function byParent(links: readonly Link[]): Map<string, Link[]> {
  const found = new Map<string, Link[]>();
  for (const link of links) {
    const list = found.get(link.parent);
    if (list) list.push(link);
    else found.set(link.parent, [link]);
  }
  return found;
}

/** Whether something has more than a pose in a layer. */
const moves = ({ channels }: Layer): boolean =>
  channels.some(({ curves }) => curves.some((curve) => curve && curve.times.length > 1));

/** A clip with the channels of one of its layers; null where none has any. */
function clipOf(name: string, layers: readonly Layer[]): Clip | null {
  const keyed = layers.filter(({ channels }) => channels.length > 0);
  const layer = keyed.find(moves) ?? keyed[0];
  if (!layer) return null;
  const others = keyed.length - 1;
  const have = others === 1 ? 'Another one has' : `${others} others have`;
  const warning = `Only the layer “${layer.name.slice(0, 80)}” of this animation was read. ${have} keys too, which were left out: merge the layers before the export.`;
  return { name, channels: layer.channels, warnings: others > 0 ? [warning] : [] };
}

/** The clips: every stack with the channels of its first layer that moves something. */
function clipsOf(objects: ReadonlyMap<string, readonly Entry[]>, links: readonly Link[]): Clip[] {
  const under = byParent(links);
  const curves = new Map((objects.get('AnimationCurve') ?? []).map((entry) => [entry.id, entry]));
  const nodes = new Set((objects.get('AnimationCurveNode') ?? []).map(({ id }) => id));
  const layers = new Map((objects.get('AnimationLayer') ?? []).map((entry) => [entry.id, entry]));
  const targets = new Map(links.filter(({ child }) => nodes.has(child)).map((link) => [link.child, link]));
  for (const link of links)
    if (nodes.has(link.child) && link.property.startsWith('Lcl ')) targets.set(link.child, link);
  const channelsOf = (layer: string): Channel[] =>
    (under.get(layer) ?? []).flatMap(({ child }): Channel[] => {
      const target = targets.get(child);
      if (!nodes.has(child) || !target?.property.startsWith('Lcl ')) return [];
      const axes: (Curve | null)[] = [null, null, null];
      for (const link of under.get(child) ?? []) {
        const [curve, axis] = [curves.get(link.child), axisOf(link.property)];
        if (curve && axis >= 0) axes[axis] = curveOf(curve);
      }
      return [{ model: target.parent, property: target.property, curves: axes }];
    });
  return (objects.get('AnimationStack') ?? []).flatMap(({ id, name }) => {
    const inside = (under.get(id) ?? []).flatMap(({ child }) => layers.get(child) ?? []);
    return (
      clipOf(
        name,
        inside.map((layer) => ({ name: layer.name, channels: channelsOf(layer.id) })),
      ) ?? []
    );
  });
}

/**
 * The hierarchy and the animation in the nodes of an FBX file.
 *
 * @throws {AppError} `unreadable-file`
 */
export function sceneOf(nodes: readonly FbxNode[]): FbxScene {
  const objects = new Map<string, Entry[]>();
  for (const node of nodes.find(({ name }) => name === 'Objects')?.children ?? []) {
    const list = objects.get(node.name);
    if (list) list.push(entryOf(node));
    else objects.set(node.name, [entryOf(node)]);
  }
  const links = linksOf(nodes.find(({ name }) => name === 'Connections'));
  const models = new Map(
    (objects.get('Model') ?? []).map(({ id, node, name }) => [
      id,
      { id, name, type: String(node.values.at(-1) ?? ''), properties: propertiesOf(node) },
    ]),
  );
  const parents = new Map(
    links
      // A property takes its value from an object that is no child: what a camera looks at.
      .filter(({ child, parent, property }) => property === '' && models.has(child) && models.has(parent))
      .map(({ child, parent }) => [child, parent]),
  );
  return {
    models,
    parents,
    clips: clipsOf(objects, links),
    settings: propertiesOf(nodes.find(({ name }) => name === 'GlobalSettings')),
  };
}
