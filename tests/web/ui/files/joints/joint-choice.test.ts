import { describe, expect, test } from 'vitest';
import { SMPL22 } from '../../../../../web/motion/skeleton/skeleton';
import {
  changedChoice,
  type ChosenJoints,
  sidesExchanged,
} from '../../../../../web/ui/files/joints/joint-choice';

const joints = SMPL22.map((_, index) => ({ name: `joint ${index}` }));
const found = {
  ...Object.fromEntries(SMPL22.map((name, index) => [name, index])),
  spine1: null,
} as unknown as ChosenJoints;

describe('joints chosen in the panel', () => {
  test('nothing is chosen where nothing was changed', () => {
    expect(changedChoice(found, { ...found }, joints)).toBeNull();
  });

  test('one change makes a choice of all, estimated ones included', () => {
    const choice = changedChoice(found, { ...found, left_wrist: 3, head: null }, joints)!;
    expect(Object.keys(choice)).toHaveLength(22);
    expect(choice).toMatchObject({ left_wrist: 'joint 3', head: null, spine1: null, left_knee: 'joint 4' });
  });

  test('exchanged sides keep the middle, and twice is as before', () => {
    const exchanged = sidesExchanged(found);
    expect(exchanged).toMatchObject({ left_knee: 5, right_knee: 4, neck: 12, spine1: null });
    expect(sidesExchanged(exchanged)).toEqual(found);
  });
});
