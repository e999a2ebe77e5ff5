/** Bytes that `isPlaylist` looks at. */
export const PLAYLIST_HEAD_BYTES = 512;

const PLAYLIST =
  /^(#EXT|\[playlist\]|<\?xml[^]*<playlist|<playlist|<asx|<smil|<mpd|(https?|file|rtsp):\/\/)/i;

/**
 * Whether a file is a list of songs (M3U, HLS, PLS, XSPF, ASX) instead of a song. A media element that gets one asks the
 * addresses in it.
 *
 * @param head its first bytes
 */
export function isPlaylist(head: Uint8Array): boolean {
  return PLAYLIST.test(new TextDecoder().decode(head).trimStart());
}
