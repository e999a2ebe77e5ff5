import type { Gltf } from './container';

/** The names that VRM gives to some nodes: by node, from a VRM 1, a VRM 0 or a VRMA file. */
export function humanoidNames({ extensions }: Gltf): Map<number, string> {
  const names = new Map<number, string>();
  const put = (node: unknown, name: unknown): void => {
    if (typeof node === 'number' && typeof name === 'string') names.set(node, name.slice(0, 40));
  };
  for (const key of ['VRMC_vrm', 'VRMC_vrm_animation', 'VRM']) {
    const bones = bonesOf(extensions[key]);
    if (Array.isArray(bones))
      for (const bone of bones as unknown[]) if (isObject(bone)) put(bone['node'], bone['bone']);
    if (isObject(bones) && !Array.isArray(bones))
      for (const [name, bone] of Object.entries(bones)) if (isObject(bone)) put(bone['node'], name);
  }
  return names;
}

function bonesOf(extension: unknown): unknown {
  const humanoid = isObject(extension) ? extension['humanoid'] : null;
  return isObject(humanoid) ? humanoid['humanBones'] : null;
}

function isObject(value: unknown): value is Record<string, unknown> {
  return value !== null && typeof value === 'object';
}
