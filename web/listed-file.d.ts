/** See tools/vite/manifest-entry.mjs. */
declare module '*?listed' {
  const file: { readonly path: string; readonly bytes: number; readonly sha256: string };
  export default file;
}
