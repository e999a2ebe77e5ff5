import { canEncodeAudio } from 'mediabunny';

let encoderLoaded: Promise<boolean> | null = null;

/**
 * Whether AAC can be encoded, the one audio codec that every player of MP4 supports. For browsers without an encoder
 * (Firefox, Chromium on Linux, Safari before 26) one of the page is loaded at the first call.
 */
export async function canEncodeAac(): Promise<boolean> {
  if (await canEncodeAudio('aac')) return true;
  encoderLoaded ??= loadEncoder();
  const loaded = await encoderLoaded;
  // An encoder that could not be loaded, because the page is offline, is tried again next time.
  if (!loaded) encoderLoaded = null;
  return loaded;
}

async function loadEncoder(): Promise<boolean> {
  try {
    const { registerAacEncoder } = await import('@mediabunny/aac-encoder');
    registerAacEncoder();
    return true;
  } catch {
    return false;
  }
}
