import { describe, expect, it } from 'vitest';
import { fileKind, isVideoName } from '../../../../web/ui/files/file-type';

const bytes = (text: string, ...more: number[]): Uint8Array =>
  Uint8Array.from([...[...text].map((letter) => letter.charCodeAt(0)), ...more]);

describe('the type of a file', () => {
  it.each([
    ['a BVH', bytes('HIERARCHY\nROOT Hips\n')],
    ['a BVH after a byte order mark', bytes('\u00ef\u00bb\u00bfHIERARCHY\n')],
    ['a BVH after blank lines', bytes('\r\n  HIERARCHY\n')],
  ])('sees %s as a leader, whatever its name', (_, head) => {
    expect(fileKind(head, 'song.mp3', 'audio/mpeg')).toBe('leader');
  });

  it.each([
    ['mp3 with tags', bytes('ID3\u0004')],
    ['bare mp3', Uint8Array.of(0xff, 0xfb, 0x90, 0x64)],
    ['aac', Uint8Array.of(0xff, 0xf1, 0x50, 0x80)],
    ['ogg', bytes('OggS')],
    ['flac', bytes('fLaC')],
    ['wav', bytes('RIFF\u0001\u0002\u0003\u0004WAVEfmt ')],
    ['aiff', bytes('FORM\u0000\u0000\u0000\u0004AIFFCOMM')],
    ['m4a', bytes('\u0000\u0000\u0000\u0020ftypM4A ')],
    ['webm', Uint8Array.of(0x1a, 0x45, 0xdf, 0xa3)],
  ])('sees %s as a song, whatever its name', (_, head) => {
    expect(fileKind(head, 'dance.bvh', '')).toBe('song');
  });

  it.each([
    ['MP4', bytes('\u0000\u0000\u0000\u0020ftypisom'), 'dance.mp4', 'video/mp4'],
    ['MOV', bytes('\u0000\u0000\u0000\u0014ftypqt  '), 'IMG_1.MOV', ''],
    ['WebM', Uint8Array.of(0x1a, 0x45, 0xdf, 0xa3), 'camera', 'video/webm'],
  ])('sees %s of the name or type of a video as one', (_, head, name, type) => {
    expect(fileKind(head, name, type)).toBe('video');
  });

  it('is told of a leader from a video by its name, also of one from the camera', () => {
    for (const name of ['IMG_1.MOV', 'dance.mp4', 'camera.webm', 'dance.3gp'])
      expect(isVideoName(name), name).toBe(true);
    for (const name of ['dance.bvh', 'Demo leader', 'mp4.npz', ''])
      expect(isVideoName(name), name).toBe(false);
  });

  it('is that of the name where the bytes do not tell', () => {
    expect(fileKind(bytes('not a hierarchy'), 'dance.BVH', '')).toBe('leader');
    expect(fileKind(bytes('just words'), 'song.mp3', '')).toBe('song');
    expect(fileKind(bytes('just words'), 'song', 'audio/x-unheard-of')).toBe('song');
  });

  it.each([
    ['clip.avi', 'video/x-msvideo', bytes('RIFF\u0001\u0002\u0003\u0004AVI LIST')],
    ['clip.AVI', '', bytes('RIFF\u0001\u0002\u0003\u0004AVI LIST')],
    ['clip.wmv', '', Uint8Array.of(0x30, 0x26, 0xb2, 0x75)],
    ['clip.mpg', '', Uint8Array.of(0, 0, 1, 0xba)],
    ['clip.mov', '', bytes('\u0000\u0000\u0000\u0008wide')],
    ['clip', 'video/x-unheard-of', bytes('words')],
  ])('is a video for %s of the type “%s”, in whatever container', (name, type, head) => {
    expect(fileKind(head, name, type)).toBe('video');
  });

  it.each(['take.mp4', 'take.webm'])('is a song for %s where neither bytes nor type tell', (name) => {
    expect(fileKind(bytes('just words'), name, '')).toBe('song');
  });

  it('is not mp3 for a UTF-16 text', () => {
    expect(fileKind(Uint8Array.of(0xff, 0xfe, 0x48, 0), 'notes.txt', 'text/plain')).toBe('unknown');
  });

  it.each([
    ['FBX', bytes('Kaydara FBX Binary  ')],
    ['GLB', bytes('glTF\u0002')],
  ])('knows %s as a leader', (_, head) => {
    expect(fileKind(head, 'dance.bin', '')).toBe('leader');
  });

  it.each([
    ['PNG', bytes('\u0089PNG')],
    ['JPEG', Uint8Array.of(0xff, 0xd8, 0xff, 0xe0)],
    ['WebP', bytes('RIFF\u0001\u0002\u0003\u0004WEBPVP8')],
    ['HEIC', bytes('\u0000\u0000\u0000\u0020ftypheic')],
  ])('knows %s as a picture', (_, head) => {
    expect(fileKind(head, 'song.mp3', 'audio/mpeg')).toBe('picture');
  });

  it('is unknown for the rest', () => {
    expect(fileKind(bytes('%PDF-1.7'), 'notes.pdf', 'application/pdf')).toBe('unknown');
    expect(fileKind(new Uint8Array(0), 'nothing', '')).toBe('unknown');
    expect(fileKind(bytes('PK\u0003\u0004'), 'notes.docx', '')).toBe('unknown');
    expect(fileKind(bytes('[1, 2]'), 'list.txt', 'text/plain')).toBe('unknown');
  });

  it('is a leader for JSON, which says itself what it lacks', () => {
    expect(fileKind(bytes('{"a": 1}'), 'list.json', 'application/json')).toBe('leader');
    expect(fileKind(bytes('[1, 2]'), 'list.json', 'application/json')).toBe('leader');
  });
});
