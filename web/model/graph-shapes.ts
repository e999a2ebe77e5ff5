import type { GraphName, Manifest } from './manifest';

/** Lengths of a tensor's axes; null where it is as long as the dance. */
type Shape = readonly (number | null)[];

/** The tensors that a graph takes and gives, by name. */
interface Tensors {
  readonly inputs: Readonly<Record<string, Shape>>;
  readonly outputs: Readonly<Record<string, Shape>>;
}

/** The tensors that this page feeds to the graphs of a model and reads from them. */
export function tensorsOf({
  skeleton,
  latent,
  audio,
}: Pick<Manifest, 'skeleton' | 'latent' | 'audio'>): Readonly<Record<GraphName, Tensors>> {
  const joints = skeleton.joints.length;
  const { block, channels, memory_width: memory } = latent;
  const [layers, streams] = [latent.layers.length, latent.streams.length];
  const state = [null, block, layers, channels];
  return {
    condition: {
      inputs: {
        leader: [null, joints, 3],
        music: [null, audio.features],
        music_valid: [null],
        role: [1],
      },
      outputs: { memory: [null, memory], unfamiliarity: [null] },
    },
    step: {
      inputs: {
        x: state,
        memory: [null, block, memory],
        valid: [null, block],
        keep: [1],
        time: [1],
        a: [1],
        b: [1],
      },
      outputs: { next: state },
    },
    decode: {
      inputs: {
        latents: [null, layers, channels],
        leader: [null, joints, 3],
        gains: [streams, layers],
        role: [1],
      },
      outputs: { reactor: [null, joints, 3] },
    },
  };
}

/** Says in a clause what differs between the tensors that a manifest declares and those it needs; null where nothing does. */
export function shapeProblem(manifest: Manifest): string | null {
  for (const { graph, kind, tensor, shape } of neededTensors(manifest)) {
    const declared = manifest.graphs[graph][kind];
    const found = Object.hasOwn(declared, tensor) ? declared[tensor]! : null;
    const what = `"${tensor}" of the graph "${graph}"`;
    if (found === null) return `has no ${what} among its ${kind}`;
    if (!fits(found, shape))
      return `declares ${what} as ${text(found)}, where its other fields make it ${text(shape)}`;
  }
  return null;
}

/** A tensor with its name and that of its graph. */
interface NamedTensor {
  readonly graph: GraphName;
  readonly kind: keyof Tensors;
  readonly tensor: string;
  readonly shape: Shape;
}

/** All tensors of all graphs, in order. */
function neededTensors(manifest: Manifest): NamedTensor[] {
  const graphs = Object.entries(tensorsOf(manifest)) as [GraphName, Tensors][];
  return graphs.flatMap(([graph, tensors]) =>
    (['inputs', 'outputs'] as const).flatMap((kind) =>
      Object.entries(tensors[kind]).map(([tensor, shape]) => ({ graph, kind, tensor, shape })),
    ),
  );
}

/** Whether a declared shape is the needed one; an axis of any length is declared by a name. */
function fits(found: readonly (string | number)[], shape: Shape): boolean {
  if (found.length !== shape.length) return false;
  return shape.every((length, axis) =>
    length === null ? typeof found[axis] === 'string' : found[axis] === length,
  );
}

function text(shape: readonly (string | number | null)[]): string {
  return `(${shape.map((length) => length ?? 'any').join(', ')})`;
}
