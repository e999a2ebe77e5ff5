import type { Role } from '../../../../web/common/role';
import { beforeEach, describe, expect, it } from 'vitest';
import {
  chosenDance,
  chosenRole,
  fileNameParts,
  savedVideo,
  selectionOf,
} from '../../../../web/ui/download/dance';
import { videoFileName } from '../../../../web/ui/download/file-name';
import { downloadChosen, savedChanged } from '../../../../web/ui/store/actions/download';
import { regionSet, shiftSet } from '../../../../web/ui/store/actions/timeline';
import { takeChosen } from '../../../../web/ui/store/actions/takes';
import { undone } from '../../../../web/ui/store/history/history';
import { modelIdentity } from '../../../../web/ui/store/reaction';
import { currentInputs } from '../../../../web/ui/store/take';
import * as change from '../../support/actions';
import { leader, song, still } from '../../support/made-state';
import { madeDancer } from '../../support/made-dancer';
import { small } from '../../support/small-manifest';
import { withLevelHead } from '../../../../web/motion/skeleton/level-head';

describe('what is downloaded', () => {
  let store: change.Store;
  const react = (id: string, motion = still(60)): void => {
    const inputs = currentInputs(store.getState())!;
    const model = modelIdentity(store.getState().manifest!);
    const reaction = { motion, latents: null, model, inputs, label: null, seconds: 1 };
    change.apply(store, change.reactionAdded(reaction, { id, at: Number(id) * 1e6 }));
  };
  /** Roles of the dancers that are written, the generated one marked. */
  const written = (): string[] => {
    const state = store.getState();
    return chosenDance(state)!.dancers.map(({ role, motion }) =>
      motion.root === state.leader?.motion.root ? role : `generated ${role}`,
    );
  };
  const choose = (role: Role | 'both'): void => {
    change.apply(store, downloadChosen({ who: selectionOf(role, store.getState()) }));
  };

  beforeEach(() => {
    store = change.createAppStore('dark');
    change.apply(store, change.manifestLoaded(small, 7));
    change.apply(store, change.leaderLoaded(leader(60)));
    change.apply(store, change.footLockSet(false));
    react('1');
  });

  it('is the generated dancer after roles were swapped, after undo and of a take in the other role', () => {
    expect([written(), chosenRole(store.getState())]).toEqual([['generated reactor'], 'reactor']);
    change.apply(store, change.rolesSwapped());
    expect(chosenRole(store.getState())).toBe('leader');
    react('2');
    expect([written(), chosenRole(store.getState())]).toEqual([['generated leader'], 'leader']);
    change.apply(store, undone());
    expect([written(), chosenRole(store.getState())]).toEqual([['generated reactor'], 'reactor']);
    change.apply(store, takeChosen('2'));
    expect([written(), chosenRole(store.getState())]).toEqual([['generated leader'], 'leader']);
  });

  it('names the model that made the dance, also when another one is on the page', () => {
    change.apply(store, change.modelOpened({ ...small, id: 'mine', name: 'Mine' }, 7));
    expect(chosenDance(store.getState())?.about.model).toEqual({ id: 'small', name: 'Small' });
    react('2');
    expect(chosenDance(store.getState())?.about.model).toEqual({ id: 'mine', name: 'Mine' });
  });

  it('is the loaded dancer or both where that is chosen, in either role', () => {
    choose('leader');
    expect([written(), chosenRole(store.getState())]).toEqual([['leader'], 'leader']);
    change.apply(store, change.rolesSwapped());
    react('2');
    expect([written(), chosenRole(store.getState())]).toEqual([['reactor'], 'reactor']);
    choose('both');
    expect(written()).toEqual(['generated leader', 'reactor']);
  });

  it('has the head level, as it is drawn', () => {
    const leaning = madeDancer({ frames: 60 });
    const { leader: loaded } = store.getState();
    change.apply(store, change.leaderLoaded({ ...loaded!, motion: leaning }));
    react('2');
    choose('leader');
    const [dancer] = chosenDance(store.getState())!.dancers;
    expect(dancer!.motion.rotations).toEqual(withLevelHead(leaning).rotations);
    expect(dancer!.motion.rotations).not.toEqual(leaning.rotations);
  });

  it('is the loop where that is chosen, as long as there is one', () => {
    change.apply(store, change.songLoaded(song(3)));
    change.apply(store, shiftSet(20));
    react('2', madeDancer({ frames: 60 }));
    choose('both');
    const whole = chosenDance(store.getState())!;
    change.apply(store, downloadChosen({ part: 'loop' }));
    expect(chosenDance(store.getState())).toEqual(whole);
    change.apply(store, regionSet({ from: 0.5, to: 1.5 }));
    const part = chosenDance(store.getState())!;
    expect(part.dancers.map(({ role }) => role)).toEqual(['leader', 'reactor']);
    part.dancers.forEach(({ motion }, i) => {
      const from = whole.dancers[i]!.motion;
      expect(motion.frames).toBe(30);
      for (const [key, width] of [
        ['root', 3],
        ['rotations', 22 * 4],
        ['positions', 22 * 3],
      ] as const)
        expect(motion[key]).toEqual(from[key].slice(15 * width, 45 * width));
    });
    // The song began 20 frames after the dance, so 5 frames after the part.
    expect(part.about).toEqual({ ...whole.about, shift: 5 });
    expect(videoFileName(fileNameParts(store.getState())!, '1080p', 'mp4')).toMatch(
      /_0\.5-1\.5s_1080p\.mp4$/,
    );
    change.apply(store, downloadChosen({ rate: 24 }));
    expect(chosenDance(store.getState())).toMatchObject({
      about: { shift: 4 },
      dancers: [{ motion: { frames: 24 } }, {}],
    });
    change.apply(store, downloadChosen({ rate: 30, part: 'whole' }));
    expect(chosenDance(store.getState())).toEqual(whole);
  });

  it('as a video was saved while it is on the stage as it was then', () => {
    const name = (): string => videoFileName(fileNameParts(store.getState())!, '1080p', 'mp4');
    const file = { name: name(), bytes: 5e6, shareable: true };
    change.apply(store, savedChanged(file));
    const saved = (): unknown => savedVideo(store.getState(), 'mp4');
    expect([saved(), savedVideo(store.getState(), 'webm')]).toEqual([file, null]);
    change.apply(store, change.seedSet(8));
    react('2');
    expect(saved()).toBeNull();
    change.apply(store, takeChosen('1'));
    expect(saved()).toBe(file);
    change.apply(store, downloadChosen({ size: '9x16' }));
    expect(saved()).toBeNull();
  });
});
