import { expect, test } from 'vitest';
import { motionFileName, pictureFileName, videoFileName } from '../../../../web/ui/download/file-name';
import { uniformGuidance, leader, song } from '../../support/made-state';

const settings = {
  guidance: uniformGuidance(1.2, 0.6),
  music: 3,
  variety: 1,
  seed: 1204,
  role: 'reactor' as const,
  height: null,
  holdHands: true,
};
const inputs = { leader: leader(90), song: song(3), shift: 0, settings };

test('a file name holds song, leader, take, seed, guidance, foot lock and role', () => {
  expect(motionFileName({ inputs, footLock: false }, 'reactor', 'bvh')).toBe(
    'descarga_leader-0412_s1204_c1.20-f0.60-m3.00_reactor.bvh',
  );
  expect(motionFileName({ inputs, footLock: true, take: 'Softer hands' }, 'both', 'glb')).toBe(
    'descarga_leader-0412_softer-hands_s1204_c1.20-f0.60-m3.00_footlock_both.glb',
  );
  expect(motionFileName({ inputs, footLock: true }, 'both', 'bvh')).toMatch(/_footlock_both-bvh\.zip$/);
  expect(motionFileName({ inputs: { ...inputs, song: null }, footLock: true }, 'reactor', 'npz')).toMatch(
    /^no-song_leader-0412_s1204_c1.20-f0.60_footlock_/,
  );
});

test('takes whose names have a dot keep what follows it', () => {
  const named = (take: string): string => motionFileName({ inputs, footLock: false, take }, 'reactor', 'bvh');
  expect(named('v1.1')).toMatch(/_v1-1_s1204_/);
  expect(named('soft.er')).toMatch(/_soft-er_s1204_/);
});

test('a file name holds the frame rate where it is not that of the page', () => {
  expect(motionFileName({ inputs, footLock: false, rate: 30 }, 'leader', 'glb')).toMatch(
    /-0412_leader\.glb$/,
  );
  expect(motionFileName({ inputs, footLock: false, rate: 24 }, 'leader', 'glb')).toMatch(
    /_leader_24fps\.glb$/,
  );
});

test('a file name holds the part of the dance that is written', () => {
  const named = { inputs, footLock: true, part: { from: 12.09, to: 20.5 } };
  expect(motionFileName(named, 'reactor', 'bvh')).toMatch(/_footlock_12\.0-20\.5s_reactor\.bvh$/);
  expect(motionFileName(named, 'leader', 'bvh')).toBe('descarga_leader-0412_12.0-20.5s_leader.bvh');
  expect(videoFileName(named, '1080p', 'webm')).toMatch(/_footlock_12\.0-20\.5s_1080p\.webm$/);
});

test('a leader alone is named after song and leader', () => {
  expect(motionFileName({ inputs, footLock: true, take: 'Softer hands' }, 'leader', 'json')).toBe(
    'descarga_leader-0412_leader.json',
  );
});

test('a video’s name ends with its size', () => {
  expect(videoFileName({ inputs, footLock: true, take: '' }, '1080p', 'webm')).toBe(
    'descarga_leader-0412_s1204_c1.20-f0.60-m3.00_footlock_1080p.webm',
  );
});

test('a picture’s name ends with its moment and size', () => {
  expect(pictureFileName({ inputs, footLock: true, take: '' }, '1080p', 12.38)).toBe(
    'descarga_leader-0412_s1204_c1.20-f0.60-m3.00_footlock_at12.3s_1080p.png',
  );
});

test('with swapped roles the leader is the generated dancer', () => {
  const swapped = { ...inputs, settings: { ...settings, role: 'leader' as const } };
  expect(motionFileName({ inputs: swapped, footLock: false }, 'leader', 'bvh')).toBe(
    'descarga_leader-0412_s1204_c1.20-f0.60-m3.00_leader.bvh',
  );
  expect(motionFileName({ inputs: swapped, footLock: false }, 'reactor', 'bvh')).toBe(
    'descarga_leader-0412_reactor.bvh',
  );
});

test('body parts that differ are marked as mixed', () => {
  const guidance = { ...settings.guidance, upper: { coarse: 3, fine: 0.6 } };
  const mixed = { ...inputs, settings: { ...settings, guidance } };
  expect(motionFileName({ inputs: mixed, footLock: false }, 'reactor', 'bvh')).toContain(
    '_c1.80-f0.60-mixed-m3.00_',
  );
});
