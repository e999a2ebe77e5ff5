/** Formats of motion files. */
export type MotionFormat = 'bvh' | 'fbx' | 'gltf' | 'vmd' | 'amc' | 'c3d' | 'numpy' | 'json' | 'csv' | 'trc';

/** Bytes from which `motionFormat` tells a format. */
export const FORMAT_BYTES = 512;

/** How files begin, whatever they are called. */
const MARKS: readonly (readonly [RegExp, MotionFormat])[] = [
  [/^\s*HIERARCHY\b/i, 'bvh'],
  [/^(Kaydara FBX Binary|\s*; FBX)/, 'fbx'],
  [/^glTF/, 'gltf'],
  [/^Vocaloid Motion Data/, 'vmd'],
  [/^\u0093NUMPY/, 'numpy'],
  [/^PathFileType/, 'trc'],
];

const ENDINGS: readonly (readonly [RegExp, MotionFormat])[] = [
  [/\.bvh$/i, 'bvh'],
  [/\.fbx$/i, 'fbx'],
  [/\.(glb|gltf|vrm|vrma)$/i, 'gltf'],
  [/\.vmd$/i, 'vmd'],
  [/\.(amc|asf)$/i, 'amc'],
  [/\.c3d$/i, 'c3d'],
  [/\.(npz|npy)$/i, 'numpy'],
  [/\.trc$/i, 'trc'],
];

/** Endings of all files that are read, for the system's file chooser. */
export const MOTION_ENDINGS =
  '.bvh,.fbx,.glb,.gltf,.bin,.vrm,.vrma,.vmd,.amc,.asf,.c3d,.npz,.npy,.json,.csv,.trc';

/**
 * The format of a motion file from its first bytes, and from its name where they do not tell; null for other files.
 *
 * @param head the first `FORMAT_BYTES` bytes, or all of a shorter file
 */
export function motionFormat(head: Uint8Array, name: string): MotionFormat | null {
  const text = String.fromCharCode(...head.subarray(0, FORMAT_BYTES)).replace(/^\u00ef\u00bb\u00bf/, '');
  const marked = MARKS.find(([mark]) => mark.test(text));
  if (marked) return marked[1];
  if (text.startsWith('PK')) return /\.npz$/i.test(name) ? 'numpy' : null;
  // A word of 0x50 follows the place of the parameters, and a C3D has no other mark.
  if (head[1] === 0x50 && /\.c3d$/i.test(name)) return 'c3d';
  if (/^\s*[{[]/.test(text) && /\.json$/i.test(name)) return 'json';
  if (/\.csv$/i.test(name) && /^(#[^\r\n]*[\r\n]+)*[^\r\n,;\t]*[,;\t]/.test(text)) return 'csv';
  if (isOtherFile(text)) return null;
  return ENDINGS.find(([ending]) => ending.test(name))?.[1] ?? null;
}

/** Whether the first bytes are those of a sound or a picture, whatever the file is called. */
function isOtherFile(text: string): boolean {
  return /^(ID3|OggS|fLaC|RIFF|FORM|GIF8|%PDF|\u0089PNG|\u00ff[\u00d8\u00e0-\u00fd]|....ftyp|.E\u00df\u00a3)/s.test(
    text,
  );
}

/**
 * Endings of files that belong to another file. Where one of them is enough: that of its name, else of its first word,
 * else whatever its name. Else all that have not the name of another one.
 */
const COMPANIONS: readonly { readonly motion: RegExp; readonly companion: RegExp; readonly one: boolean }[] =
  [
    { motion: /\.amc$/i, companion: /\.asf$/i, one: true },
    { motion: /\.vrma$/i, companion: /\.vrm$/i, one: true },
    { motion: /\.gltf$/i, companion: /\.bin$/i, one: false },
  ];

const stemOf = ({ name }: { readonly name: string }): string => name.replace(/\.\w+$/, '').toLowerCase();

/** Whether a file has the name of another one, but for its ending. */
const isNamed = ({ name }: { readonly name: string }, stem: string): boolean =>
  name.toLowerCase().startsWith(`${stem}.`);

/** Whether a name begins with a whole word: 60_10 with 60, not with 6. */
const startsWithWord = (name: string, word: string): boolean =>
  name.startsWith(word) && /[^\p{L}\p{N}]/u.test(name.charAt(word.length));

/**
 * Files that are read together, the one with the motion first: an AMC with its ASF skeleton, a VRMA with the VRM it
 * moves, a glTF with its bin. All other files stay alone.
 */
export function groupCompanions<T extends { readonly name: string }>(files: readonly T[]): T[][] {
  const taken = new Set<T>();
  const groups = files.map((file): T[] => {
    const rule = COMPANIONS.find(({ motion }) => motion.test(file.name));
    const stem = stemOf(file);
    const others = rule ? files.filter((other) => rule.companion.test(other.name)) : [];
    const named = others.filter((other) => isNamed(other, stem));
    const begun = others.filter((other) => startsWithWord(stem, stemOf(other)));
    const isOfOther = (other: T): boolean =>
      files.some((one) => rule?.motion.test(one.name) && isNamed(other, stemOf(one)));
    const mine = rule?.one
      ? ([named, begun].find((some) => some.length > 0) ?? others)
      : others.filter((other) => isNamed(other, stem) || !isOfOther(other));
    for (const other of mine) taken.add(other);
    return [file, ...mine];
  });
  return groups.filter(([file]) => !taken.has(file!));
}
