import {
  BufferGeometry,
  Color,
  Group,
  LessEqualDepth,
  MeshBasicMaterial,
  ShaderMaterial,
  SkinnedMesh,
  type ColorRepresentation,
  type Skeleton,
} from 'three';

/** A see-through body: its outline is clear, surfaces that face the eye are almost transparent. */
export interface Ghost {
  readonly object: Group;
  setGeometry(geometry: BufferGeometry): void;
  setTint(colour: ColorRepresentation, opacity: GhostOpacity): void;
  /** Whether the body casts a shadow. */
  setShadow(cast: boolean): void;
  dispose(): void;
}

/** Opacity where the surface faces the eye and where it is seen at a grazing angle, 0 to 1. */
export interface GhostOpacity {
  readonly facing: number;
  readonly grazing: number;
}

const VERTEX = /* glsl */ `
#include <common>
#include <skinning_pars_vertex>
varying vec3 vFacing;
varying vec3 vToEye;
void main() {
  #include <beginnormal_vertex>
  #include <skinbase_vertex>
  #include <skinnormal_vertex>
  #include <defaultnormal_vertex>
  #include <begin_vertex>
  #include <skinning_vertex>
  #include <project_vertex>
  vFacing = transformedNormal;
  vToEye = -mvPosition.xyz;
}`;
const FRAGMENT = /* glsl */ `
uniform vec3 tint;
uniform float facing;
uniform float grazing;
varying vec3 vFacing;
varying vec3 vToEye;
void main() {
  float turned = 1.0 - abs(dot(normalize(vFacing), normalize(vToEye)));
  gl_FragColor = vec4(tint, mix(facing, grazing, pow(turned, 2.2)));
  #include <colorspace_fragment>
}`;

/** Ghosts are drawn after everything solid: their depths first, so that only the nearest surface is seen. */
const DEPTH_ORDER = 10;
const TINT_ORDER = 11;

export function createGhost(skeleton: Skeleton): Ghost {
  const depth = new MeshBasicMaterial({
    colorWrite: false,
    transparent: true,
    // Slightly behind, so that the second pass passes the depth test against the first in spite of rounding.
    polygonOffset: true,
    polygonOffsetFactor: 1,
    polygonOffsetUnits: 2,
  });
  const uniforms = { tint: { value: new Color() }, facing: { value: 0 }, grazing: { value: 0 } };
  const rim = new ShaderMaterial({
    vertexShader: VERTEX,
    fragmentShader: FRAGMENT,
    uniforms,
    transparent: true,
    depthWrite: false,
    depthFunc: LessEqualDepth,
  });
  const object = new Group();
  const passes = [depth, rim].map((material, pass) => {
    const mesh = new SkinnedMesh(new BufferGeometry(), material);
    mesh.renderOrder = pass === 0 ? DEPTH_ORDER : TINT_ORDER;
    mesh.frustumCulled = false;
    mesh.bind(skeleton);
    object.add(mesh);
    return mesh;
  });
  return {
    object,
    setGeometry(geometry) {
      for (const mesh of passes) mesh.geometry = geometry;
    },
    setTint(colour, { facing, grazing }) {
      uniforms.tint.value.set(colour);
      uniforms.facing.value = facing;
      uniforms.grazing.value = grazing;
    },
    setShadow(cast) {
      passes[0]!.castShadow = cast;
    },
    dispose() {
      depth.dispose();
      rim.dispose();
    },
  };
}
