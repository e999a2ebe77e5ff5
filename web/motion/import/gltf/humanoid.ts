import type { Gltf } from './container';

/** The names that VRM gives to some nodes: by node, from a VRM 1, a VRM 0 or a VRMA file. */
export function humanoidNames({ extensions }: Gltf): Map<number, string> {
  const names = new Map<number, string>();
  for (const key of ['VRMC_vrm', 'VRMC_vrm_animation', 'VRM'])
    for (const [node, name] of nodesAndNames(bonesOf(extensions[key])))
      if (typeof node === 'number' && typeof name === 'string') names.set(node, name.slice(0, 40));
  return names;
}

/** Pairs of node and name, not checked: VRM 0 lists bones, the others have them by name. */
function nodesAndNames(bones: unknown): [node: unknown, name: unknown][] {
  if (Array.isArray(bones)) return bones.filter(isObject).map((bone) => [bone['node'], bone['bone']]);
  if (!isObject(bones)) return [];
  return Object.entries(bones).flatMap(([name, bone]) => (isObject(bone) ? [[bone['node'], name]] : []));
}

function bonesOf(extension: unknown): unknown {
  const humanoid = isObject(extension) ? extension['humanoid'] : null;
  return isObject(humanoid) ? humanoid['humanBones'] : null;
}

function isObject(value: unknown): value is Record<string, unknown> {
  return value !== null && typeof value === 'object';
}
