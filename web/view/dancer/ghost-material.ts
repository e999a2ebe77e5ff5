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

/** A body that is seen through: only its outline is clear, its front a breath of colour. */
export interface Glass {
  readonly object: Group;
  setGeometry(geometry: BufferGeometry): void;
  setTint(colour: ColorRepresentation, clarity: Clarity): void;
  /** Whether the body still throws its shadow. */
  setShadow(cast: boolean): void;
  dispose(): void;
}

/** How much of the colour shows where the surface faces the eye and where it turns away, 0 to 1. */
export interface Clarity {
  readonly facing: number;
  readonly grazing: number;
}

const VERTEX = /* glsl */ `
#include <common>
#include <skinning_pars_vertex>
varying vec3 vAcross;
varying vec3 vToEye;
void main() {
  #include <beginnormal_vertex>
  #include <skinbase_vertex>
  #include <skinnormal_vertex>
  #include <defaultnormal_vertex>
  #include <begin_vertex>
  #include <skinning_vertex>
  #include <project_vertex>
  vAcross = transformedNormal;
  vToEye = -mvPosition.xyz;
}`;
const FRAGMENT = /* glsl */ `
uniform vec3 tint;
uniform float facing;
uniform float grazing;
varying vec3 vAcross;
varying vec3 vToEye;
void main() {
  float away = 1.0 - abs(dot(normalize(vAcross), normalize(vToEye)));
  gl_FragColor = vec4(tint, mix(facing, grazing, pow(away, 2.2)));
  #include <colorspace_fragment>
}`;

/** Bodies of glass come after everything solid: all of their depths first, so that only the nearest surface shows. */
const DEPTH_ORDER = 10;
const TINT_ORDER = 11;

export function createGlass(skeleton: Skeleton): Glass {
  const depth = new MeshBasicMaterial({
    colorWrite: false,
    transparent: true,
    // A hair's breadth behind, so that the second pass passes the test against the first whatever it rounds.
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
