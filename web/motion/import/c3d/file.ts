import { AppError } from '../../../common/error';
import { type Vec3, writeVec } from '../../math/vec3';
import { refuseTooLong } from '../../retarget/length';

const BLOCK = 512;
/** Marks of the processors whose numbers a file has. */
const DEC = 85;
const MIPS = 86;
/** Largest number of parameters of one kind that are read as a list of texts. */
const MAX_TEXTS = 2000;

/** The markers of a C3D file over time. */
export interface C3d {
  readonly labels: readonly string[];
  readonly frames: number;
  readonly rate: number;
  /** Unit as the file names it. */
  readonly unit: string;
  /** frames x labels x 3; NaN where a marker was not seen. */
  readonly places: Float32Array;
  /** Number of frames that the file states; null where it has more than its head can state. */
  readonly stated: number | null;
}

/** The error of a file that is not as C3D says. */
function damagedC3d(what: string, cause?: unknown): AppError {
  return new AppError(
    'unreadable-file',
    `The C3D file is damaged: ${what}.`,
    'Download, copy or export it again.',
    { cause },
  );
}

/** Numbers of a C3D file in the form of the processor that wrote it. */
class Numbers {
  private readonly view: DataView;

  constructor(
    bytes: Uint8Array,
    private readonly processor: number,
  ) {
    this.view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  }

  int16(at: number): number {
    return this.view.getInt16(at, this.processor !== MIPS);
  }

  uint16(at: number): number {
    return this.view.getUint16(at, this.processor !== MIPS);
  }

  float(at: number): number {
    if (this.processor !== DEC) return this.view.getFloat32(at, this.processor !== MIPS);
    // A DEC float has its two words exchanged and an exponent larger by two.
    const words = new DataView(new ArrayBuffer(4));
    words.setUint16(0, this.view.getUint16(at, true));
    words.setUint16(2, this.view.getUint16(at + 2, true));
    return words.getFloat32(0) / 4;
  }
}

/** A parameter: its values are read when they are asked for. */
interface Parameter {
  readonly type: number;
  readonly sizes: readonly number[];
  readonly data: number;
}

/** The parameters by `GROUP:NAME`. */
function parametersOf(bytes: Uint8Array, start: number, numbers: Numbers): Map<string, Parameter> {
  const groups = new Map<number, string>();
  const found: { group: number; name: string; parameter: Parameter }[] = [];
  const signed = (at: number): number => (bytes[at]! << 24) >> 24;
  for (let at = start + 4; at + 4 < bytes.length;) {
    const length = Math.abs(signed(at));
    const id = signed(at + 1);
    if (length === 0 || id === 0) break;
    const name = String.fromCharCode(...bytes.subarray(at + 2, at + 2 + length)).toUpperCase();
    const link = at + 2 + length;
    if (link + 2 > bytes.length) break;
    if (id < 0) groups.set(-id, name);
    else {
      const count = bytes[link + 3] ?? 0;
      const sizes = [...bytes.subarray(link + 4, link + 4 + count)];
      found.push({ group: id, name, parameter: { type: signed(link + 2), sizes, data: link + 4 + count } });
    }
    const step = numbers.uint16(link);
    if (step === 0) break;
    at = link + step;
  }
  return new Map(
    found.map(({ group, name, parameter }) => [`${groups.get(group) ?? ''}:${name}`, parameter]),
  );
}

/** The texts of a parameter, without the spaces that fill them up. */
function textsOf(bytes: Uint8Array, parameter: Parameter | undefined): string[] {
  if (!parameter || parameter.type !== -1) return [];
  const [width = 0, ...others] = parameter.sizes;
  const count = Math.min(
    MAX_TEXTS,
    others.reduce((product, size) => product * size, 1),
  );
  return Array.from({ length: count }, (_, i) =>
    String.fromCharCode(
      ...bytes.subarray(parameter.data + i * width, parameter.data + (i + 1) * width),
    ).trim(),
  );
}

/**
 * Reads the markers of a C3D file: whole numbers or floats, of Intel, DEC or MIPS processors.
 *
 * @throws {AppError} `unreadable-file` or `too-long`
 */
export function readC3dFile(bytes: Uint8Array): C3d {
  const start = ((bytes[0] ?? 0) - 1) * BLOCK;
  if (bytes.length < 2 * BLOCK || bytes[1] !== 0x50 || start < 0 || start + 4 > bytes.length)
    throw damagedC3d('its head is not that of a C3D file');
  try {
    return readMarkers(bytes, start);
  } catch (cause) {
    if (cause instanceof AppError) throw cause;
    throw damagedC3d('it ends too early', cause);
  }
}

/** What the first block of a file says about its data. */
interface Head {
  readonly points: number;
  /** Factor of whole numbers; below 0 where the numbers are floats. */
  readonly scale: number;
  /** First byte of the data, and bytes of a frame. */
  readonly data: number;
  readonly row: number;
  /** Number of frames; null where it has more than the block can state. */
  readonly stated: number | null;
}

function headOf(numbers: Numbers): Head {
  const points = numbers.uint16(2);
  const analog = numbers.uint16(4);
  const [first, last] = [numbers.uint16(6), numbers.uint16(8)];
  const scale = numbers.float(12);
  return {
    points,
    scale,
    data: (numbers.uint16(16) - 1) * BLOCK,
    row: (points * 4 + analog) * wordBytes(scale),
    // A file of more than 65,535 frames says so elsewhere; what is there counts.
    stated: last >= first && last < 65_535 ? last - first + 1 : null,
  };
}

/** Bytes of a number of a marker. */
function wordBytes(scale: number): number {
  return scale < 0 ? 4 : 2;
}

function readMarkers(bytes: Uint8Array, start: number): C3d {
  const numbers = new Numbers(bytes, bytes[start + 3]!);
  const head = headOf(numbers);
  const { points, data, row, stated } = head;
  const parameters = parametersOf(bytes, start, numbers);
  const labels = ['POINT:LABELS', 'POINT:LABELS2', 'POINT:LABELS3'].flatMap((name) =>
    textsOf(bytes, parameters.get(name)),
  );
  const rateParameter = parameters.get('POINT:RATE');
  const rate = rateParameter?.type === 4 ? numbers.float(rateParameter.data) : numbers.float(20);
  const there = row > 0 && data > 0 ? Math.floor((bytes.length - data) / row) : 0;
  const frames = Math.min(stated ?? there, there);
  if (points === 0 || labels.length === 0 || !(frames > 0)) throw damagedC3d('it holds no markers');
  refuseTooLong(frames, points * 3);
  const places = placesOf(numbers, head, frames);
  return {
    labels: Array.from({ length: points }, (_, point) => labels[point] ?? `*${point}`),
    // What fills the last block up looks like frames in which no marker was seen.
    frames: stated === null ? seenFrames(places, points * 3) : frames,
    stated,
    rate,
    unit: textsOf(bytes, parameters.get('POINT:UNITS'))[0] ?? 'mm',
    places,
  };
}

/** The places of all markers, frames x points x 3. */
function placesOf(numbers: Numbers, { points, scale, data, row }: Head, frames: number): Float32Array {
  const places = new Float32Array(frames * points * 3);
  for (let frame = 0; frame < frames; frame++)
    for (let point = 0; point < points; point++) {
      const at = data + frame * row + point * 4 * wordBytes(scale);
      writeVec(places, frame * points + point, placeAt(numbers, at, scale));
    }
  return places;
}

const UNSEEN: Vec3 = [NaN, NaN, NaN];

/** The place of a marker that is written from a byte on: three numbers and a word about them. */
function placeAt(numbers: Numbers, at: number, scale: number): Vec3 {
  const isFloat = scale < 0;
  const word = (i: number): number => (isFloat ? numbers.float(at + 4 * i) : numbers.int16(at + 2 * i));
  const factor = isFloat ? 1 : scale;
  const place: Vec3 = [word(0) * factor, word(1) * factor, word(2) * factor];
  // The fourth word is below 0 where the marker was not seen; some programs only leave its place at 0.
  return word(3) >= 0 && place.some((value) => value !== 0) ? place : UNSEEN;
}

/** Number of frames up to the last one in which a marker was seen. */
function seenFrames(places: Float32Array, size: number): number {
  let frames = places.length / size;
  while (frames > 0 && places.subarray((frames - 1) * size, frames * size).every(Number.isNaN)) frames--;
  return frames;
}
