import { canEncodeAudio } from 'mediabunny';

let brought: Promise<boolean> | null = null;

/**
 * Whether AAC can be written, the one sound that every player of MP4 knows. Browsers without an encoder of their own
 * (Firefox, Chromium on Linux, Safari before 26) get one that comes with the page, when it is first asked for.
 */
export async function canEncodeAac(): Promise<boolean> {
  if (await canEncodeAudio('aac')) return true;
  brought ??= bring();
  const came = await brought;
  // What could not come, because the page has gone offline, may come next time.
  if (!came) brought = null;
  return came;
}

async function bring(): Promise<boolean> {
  try {
    const { registerAacEncoder } = await import('@mediabunny/aac-encoder');
    registerAacEncoder();
    return true;
  } catch {
    return false;
  }
}
