import { describe, expect, test } from 'vitest';
import { sortStudyFiles } from '../../../../web/ui/study/file-names';

const sort = (...names: string[]) => sortStudyFiles(names.map((name) => ({ name })));

describe('the files of a study', () => {
  test('are sorted by duet and method', () => {
    const [salsa, waltz, ...others] = sort(
      'my_waltz_leader.npz',
      'salsa_truth.bvh',
      'salsa.mp3',
      'salsa_leader.bvh',
      'my_waltz_ours.bvh',
      'salsa_ours.fbx',
      'my_waltz_edge.bvh',
    ).toSorted((a, b) => (a.name < b.name ? 1 : -1));
    expect(others).toEqual([]);
    expect(salsa).toMatchObject({
      name: 'salsa',
      leader: { name: 'salsa_leader.bvh' },
      song: { name: 'salsa.mp3' },
    });
    expect([...salsa!.partners.keys()].sort()).toEqual(['ours', 'truth']);
    expect(waltz).toMatchObject({ name: 'my_waltz', song: null });
  });

  test.each([
    [['dance.bvh'], /dance\.bvh does not say/],
    [['a_ours.bvh', 'a_truth.bvh'], /a has no leader: a_leader\.bvh/],
    [['a_leader.bvh', 'a_ours.bvh'], /a has one partner only/],
    [['a_leader.bvh'], /a has no partner/],
    [['a_leader.bvh', 'a_ours.bvh', 'a_ours.fbx', 'a_truth.bvh'], /two files of “ours”/],
    [['a.mp3'], /no dance among these files/],
  ])('%j says what is missing', (names, reason) => {
    expect(() => sort(...names)).toThrow(reason);
  });
});
