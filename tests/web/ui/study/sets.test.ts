import { describe, expect, test } from 'vitest';
import type { GenerateRequest } from '../../../../web/model/client';
import { readLeaderFile } from '../../../../web/motion/import/read';
import { solve } from '../../../../web/motion/fit/ik';
import { headingOf } from '../../../../web/motion/skeleton/heading';
import { J } from '../../../../web/motion/skeleton/skeleton';
import { builtInSet, mirrored } from '../../../../web/ui/study/built-in-set';
import { setOfFiles } from '../../../../web/ui/study/file-set';
import { contentOf } from '../../../../web/ui/study/set';
import { bvhText } from '../../../e2e/support/files';
import { madeDancer } from '../../support/made-dancer';
import { songData, still } from '../../support/made-state';
import { small } from '../../support/small-manifest';

const read = async ({ files }: { files: readonly { name: string; bytes: Uint8Array }[] }) => {
  const file = await readLeaderFile(files);
  return { file, motion: solve(file.clip) };
};
const motionFile = (name: string, sway: number): File => new File([bvhText({ frames: 40, sway })], name);

describe('a set of files', () => {
  const files = [
    motionFile('walk_leader.bvh', 1),
    motionFile('walk_ours.bvh', 0.5),
    motionFile('walk_truth.bvh', 1.5),
    new File(['ID3'], 'walk.mp3'),
  ];

  test('has every partner, its song, and ours as the reference', async () => {
    const shares: number[] = [];
    const set = await setOfFiles(files, read, (share) => shares.push(share));
    expect(shares).toEqual([1 / 3, 2 / 3, 1]);
    expect(set.reference).toBe('ours');
    const [duet] = set.duets;
    expect(duet).toMatchObject({ name: 'walk', methods: ['ours', 'truth'] });
    expect(await duet!.song!.text()).toBe('ID3');
    const [leader, ours, truth] = [
      await duet!.leader(),
      await duet!.partner('ours'),
      await duet!.partner('truth'),
    ];
    expect(leader.frames).toBe(40);
    expect(ours.positions).not.toEqual(truth.positions);
    expect(contentOf(set)).toBe('walk: ours, truth');
  });

  test('names the file that can’t be read', async () => {
    const broken = new File(['HIERARCHY\nROOT'], 'walk_edge.bvh');
    await expect(setOfFiles([...files, broken], read, () => undefined)).rejects.toThrow(/^walk_edge\.bvh: /);
  });

  test('without ours compares all with each other', async () => {
    const [leader, , truth] = files;
    const set = await setOfFiles([leader!, truth!, motionFile('walk_edge.bvh', 0)], read, () => undefined);
    expect(set.reference).toBeNull();
  });
});

describe('the set that needs no files', () => {
  async function made() {
    const requests: GenerateRequest[] = [];
    const asked: string[] = [];
    let failures = 1;
    const set = await builtInSet({
      file: (path) => {
        asked.push(path);
        return Promise.resolve(new Blob([path]));
      },
      readLeader: () => {
        const motion = madeDancer({ frames: 30 });
        const file = { clip: motion, report: {} } as unknown as Awaited<ReturnType<typeof read>>['file'];
        return Promise.resolve({ file, motion });
      },
      loadSong: () => Promise.resolve(songData(1)),
      generator: () => {
        if (failures-- > 0) return Promise.reject(new Error('no connection'));
        return Promise.resolve({
          manifest: small,
          generate: (request: GenerateRequest) => {
            requests.push(request);
            const motion = still(30);
            const seconds = { steps: 0, decode: 0, solve: 0 };
            return Promise.resolve({
              ...{ motion, locked: motion, latents: new Float32Array(), unfamiliarity: 0, seconds },
            });
          },
        });
      },
    });
    return { set, requests, asked };
  }

  test('generates ours at the defaults and the others at the ends of coarse guidance, each once', async () => {
    const { set, requests } = await made();
    expect(set.duets.map(({ name }) => name)).toEqual(['demo', 'slow', 'quick', 'turning', 'playful']);
    const [, slow] = set.duets;
    await expect(slow!.partner('ours')).rejects.toThrow('no connection');
    for (const method of ['ours', 'coarse-low', 'coarse-high', 'ours']) await slow!.partner(method);
    expect(requests).toHaveLength(3);
    const { coarse, fine } = small.guidance;
    const layers = small.latent.layers.length;
    expect(requests.map(({ guidance }) => Array.from(guidance.subarray(0, layers)))).toEqual(
      [coarse.default, coarse.min, coarse.max].map((value) => [
        Math.fround(value),
        ...new Array<number>(layers - 1).fill(Math.fround(fine.default)),
      ]),
    );
    expect(new Set(requests.map(({ seed }) => seed)).size).toBe(1);
  });

  test('the image of the leader faces the leader, with right for left', async () => {
    const { set } = await made();
    const { positions } = await set.duets[0]!.partner('mirror');
    const leader = madeDancer({ frames: 30 }).positions;
    const at = (from: Float32Array, joint: number): number[] =>
      [0, 1, 2].map((axis) => from[3 * joint + axis]!);
    const turn = headingOf(positions.subarray(0, 66)) - headingOf(leader.subarray(0, 66));
    expect(Math.abs(Math.cos(turn) + 1)).toBeLessThan(0.05);
    const apart = (joint: number, other: number): number =>
      Math.hypot(...at(positions, joint).map((value, axis) => value - at(leader, other)[axis]!));
    expect(apart(J.pelvis, J.pelvis)).toBeGreaterThan(0.85);
    expect(apart(J.pelvis, J.pelvis)).toBeLessThan(0.95);
    expect(at(positions, J.right_wrist)[1]).toBeCloseTo(at(leader, J.left_wrist)[1]!, 1);
    expect(mirrored(madeDancer({ frames: 30 })).positions).toEqual(positions);
  });
});
