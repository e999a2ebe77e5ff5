/** See tools/vite/manifest-entry.mjs. */
declare module '*?manifest-entry' {
  const file: { readonly path: string; readonly bytes: number; readonly sha256: string };
  export default file;
}
