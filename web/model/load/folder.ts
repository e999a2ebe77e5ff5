/** A model's files by their path inside its folder, as in 'manifest.json'. */
export type ModelFolder = Readonly<Record<string, Blob>>;

/**
 * Answers for a folder of files as `fetch` does for a server.
 *
 * @param root address that the paths are relative to; nothing is ever asked of it
 */
export function folderFetch(folder: ModelFolder, root: string): typeof fetch {
  const files = new Map(Object.entries(folder).map(([path, file]) => [new URL(path, root).href, file]));
  return (address) => {
    const url = address instanceof Request ? address.url : String(address);
    const file = files.get(url);
    return Promise.resolve(file === undefined ? new Response(null, { status: 404 }) : new Response(file));
  };
}
