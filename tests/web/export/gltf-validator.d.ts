/** The part of the Khronos glTF validator that tests use; the package brings no types. */
declare module 'gltf-validator' {
  export interface Issue {
    readonly code: string;
    readonly message: string;
    readonly pointer: string;
    /** 0 error, 1 warning, 2 information, 3 hint. */
    readonly severity: number;
  }
  export interface Report {
    readonly issues: {
      readonly numErrors: number;
      readonly numWarnings: number;
      readonly messages: readonly Issue[];
    };
    readonly info: {
      readonly animationCount: number;
      readonly totalVertexCount: number;
      readonly totalTriangleCount: number;
    };
  }
  /** @param data a whole GLB file */
  export function validateBytes(data: Uint8Array): Promise<Report>;
}
