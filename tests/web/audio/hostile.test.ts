import { describe, expect, it } from 'vitest';
import { analyse } from '../../../web/audio/analyse';
import { isPlaylist } from '../../../web/audio/decode';

const bytes = (text: string): Uint8Array => new TextEncoder().encode(text);

describe('a playlist', () => {
  it.each([
    ['M3U', '#EXTM3U\n#EXTINF:123,Song\nhttps://example.org/song.mp3\n'],
    ['M3U with a byte order mark', '\uFEFF#EXTM3U\nhttps://example.org/song.mp3\n'],
    ['HLS', '#EXTM3U\n#EXT-X-VERSION:3\n#EXTINF:10,\nhttps://example.org/part.ts\n'],
    ['PLS', '[playlist]\nFile1=https://example.org/song.mp3\n'],
    ['XSPF', '<?xml version="1.0"?>\n<playlist version="1" xmlns="http://xspf.org/ns/0/">'],
    ['ASX after an empty line', '\n<ASX version="3.0"><entry><ref href="https://example.org/song.mp3"/>'],
    ['DASH', '<?xml version="1.0"?>\n<MPD xmlns="urn:mpeg:dash:schema:mpd:2011">'],
    ['SMIL', '<smil><body><audio src="https://example.org/song.mp3"/>'],
    ['a list of addresses', 'https://example.org/song.mp3\n'],
    ['the address of a stream', 'rtsp://example.org/song\n'],
  ])('%s is told from a song', (_, text) => {
    expect(isPlaylist(bytes(text))).toBe(true);
  });

  it.each(['RIFF....WAVEfmt ', 'ID3\u0004', 'OggS', 'fLaC', ''])('%s begins a song', (text) => {
    expect(isPlaylist(bytes(text))).toBe(false);
  });
});

describe('samples that are no sound', () => {
  it.each([NaN, Infinity, -Infinity, 1e30])('%s is refused with its time', (value) => {
    const [left, right] = [new Float32Array(44100), new Float32Array(44100)];
    right[22050] = value;
    expect(() => analyse([left, right], 44100, undefined as never, () => undefined)).toThrow(
      'The song is damaged at 0.50 seconds',
    );
  });
});
