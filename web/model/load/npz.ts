import { AppError } from '../../common/error';
import { type DamageError, type NpzArray, openNpy, unzipArrays } from '../../common/npz';

/** Largest size of all arrays together, bytes. */
const MAX_BYTES = 64 * 1024 * 1024;

const damaged: DamageError = (message, cause) =>
  new AppError(
    'model-corrupt',
    message,
    'Export the model again and copy its whole folder, or load the page again.',
    { cause },
  );

/**
 * Reads a model's NumPy archive.
 *
 * @throws {AppError} `model-corrupt` where the archive, an array's header or a value is wrong
 */
export function readNpz(bytes: Uint8Array): Map<string, NpzArray> {
  const files = unzipArrays(bytes, MAX_BYTES, damaged);
  return new Map([...files].map(([name, content]) => [name, openNpy(content, name, damaged).read()]));
}
