import { binaryFbx, node, type Node, property, TICKS, type Value, vector } from './fbx';
import type { Vec3 } from '../../../../web/motion/math/vec3';

/** An object of a file, by its name; its number is its place in the list, from 1. */
export interface FbxObject {
  readonly name: string;
  /** LimbNode unless said. */
  readonly type?: string;
  /** Name of what it hangs on. */
  readonly parent?: string;
  readonly translation?: Vec3;
  /** Degrees. */
  readonly rotation?: Vec3;
  readonly scale?: Vec3;
  /** 0 RrSs, 1 RSrs, 2 Rrs; not written unless said. */
  readonly inheritType?: number;
}

interface Options {
  /** Names of a child, of a parent and of the property that connects them. */
  readonly links?: readonly (readonly [string, string, string])[];
  /** By the name of each layer of the one clip: the object whose height has keys of the values 1, 2 and 3 in it, if any. */
  readonly layers?: readonly (readonly [string, string | null])[];
  /** Nodes that are added to the objects. */
  readonly others?: readonly Node[];
}

const titled = (kind: string, id: number, name: string, type = '', inside: readonly Node[] = []): Node =>
  node(
    kind,
    [
      ['L', id],
      ['S', `${name}\0\u0001${kind}`],
      ['S', type],
    ],
    inside,
  );

/** A binary FBX file of any objects, with a clip of three frames that moves the first one along y, or has the given layers. */
export function writeFbxObjects(
  objects: readonly FbxObject[],
  { links = [], layers = [['Base', objects[0]!.name]], others = [] }: Options = {},
): Uint8Array<ArrayBuffer> {
  const idOf = (name: string | undefined): number => objects.findIndex((one) => one.name === name) + 1;
  const link = (child: number, parent: number, name?: string): Node => {
    const values: Value[] = [
      ['S', name === undefined ? 'OO' : 'OP'],
      ['L', child],
      ['L', parent],
    ];
    return node('C', name === undefined ? values : [...values, ['S', name]]);
  };
  const models = objects.map(({ name, type = 'LimbNode', translation, rotation, scale, inheritType }, i) =>
    titled('Model', i + 1, name, type, [
      node(
        'Properties70',
        [],
        [
          ...(inheritType === undefined ? [] : [property('InheritType', 'enum', ['I', inheritType])]),
          ...(translation ? [vector('Lcl Translation', translation)] : []),
          ...(rotation ? [vector('Lcl Rotation', rotation)] : []),
          ...(scale ? [vector('Lcl Scaling', scale)] : []),
        ],
      ),
    ]),
  );
  const stack = 1000;
  const animation = layers.flatMap(([name, moved], i) => {
    const [layer, curves, curve] = [2000 + i, 3000 + i, 4000 + i];
    if (moved === null)
      return { nodes: [titled('AnimationLayer', layer, name)], links: [link(layer, stack)] };
    return {
      nodes: [
        titled('AnimationLayer', layer, name),
        titled('AnimationCurveNode', curves, 'T'),
        titled('AnimationCurve', curve, '', '', [
          node('KeyTime', [['l', [0, TICKS / 30, TICKS / 15]]]),
          node('KeyValueFloat', [['f', [1, 2, 3]]]),
        ]),
      ],
      links: [
        link(layer, stack),
        link(curves, layer),
        link(curves, idOf(moved), 'Lcl Translation'),
        link(curve, curves, 'd|Y'),
      ],
    };
  });
  return binaryFbx(
    [
      node(
        'Objects',
        [],
        [
          ...models,
          ...others,
          titled('AnimationStack', stack, 'Take'),
          ...animation.flatMap(({ nodes }) => nodes),
        ],
      ),
      node(
        'Connections',
        [],
        [
          ...objects.map(({ parent }, i) => link(i + 1, idOf(parent))),
          ...links.map(([child, parent, name]) => link(idOf(child), idOf(parent), name)),
          ...animation.flatMap((one) => one.links),
        ],
      ),
    ],
    true,
  );
}
