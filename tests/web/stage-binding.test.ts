import type { Role } from '../../web/common/role';
import { beforeAll, expect, it, vi } from 'vitest';
import type { DancerOptions, Stage } from '../../web/view/stage';
import type * as binding from '../../web/stage-binding';
import type { Inputs, Take } from '../../web/ui/store/reaction';
import type { AppState } from '../../web/ui/store/state';
import { initialState } from '../../web/ui/store/store';
import { partReadSet } from '../../web/ui/store/actions/files';
import { compareSet, takesSwapped, takeChosen } from '../../web/ui/store/actions/takes';
import { playbackSet } from '../../web/ui/store/actions/view';
import * as change from './support/actions';
import { uniformGuidance, leader, still } from './support/made-state';

let bindStage: typeof binding.bindStage;
let openCamera: typeof binding.openCamera;
let withPartRead: typeof binding.withPartRead;
beforeAll(async () => {
  // Node has no screen to ask.
  vi.stubGlobal('matchMedia', () => ({ matches: false }));
  ({ bindStage, openCamera, withPartRead } = await import('../../web/stage-binding'));
});

type Dancers = Parameters<Stage['setDancers']>[0];

const dancer = leader(30);
const take = (id: string): Take => {
  const settings = {
    guidance: uniformGuidance(1, 1),
    music: 1,
    variety: 1,
    seed: 1,
    role: 'reactor' as Role,
    height: null,
    holdHands: true,
  };
  const inputs: Inputs = { leader: dancer, song: null, shift: 0, settings };
  const reaction = { motion: still(30), latents: null, inputs, label: null, seconds: 1 };
  return { id, number: 1, name: null, starred: false, createdAt: 0, reaction };
};

/** A stage that tells which dancers it is given, and does nothing else. */
function stageThatCalls(setDancers: (shown: Dancers, how?: DancerOptions) => void): Stage {
  const nothing = (): void => undefined;
  return new Proxy(
    { setDancers },
    { get: (known, name) => (name in known ? known.setDancers : nothing) },
  ) as unknown as Stage;
}

it('crossfades from one take to the next, but not in a split view', () => {
  const takes = [take('a'), take('b'), take('c')];
  const store = change.createAppStore('dark');
  const state: Partial<AppState> = {
    ...takes[0]!.reaction.inputs,
    reaction: takes[0]!.reaction,
    takes,
    other: 'b',
  };
  store.setState({ ...initialState('dark'), ...state });
  const crossfades: (boolean | undefined)[] = [];
  const stage = stageThatCalls((_, how) => crossfades.push(how?.crossfade));
  const stop = bindStage(stage, store);
  const crossfadeAfter = (...changes: change.Change[]): boolean | undefined => {
    for (const one of changes) change.apply(store, one);
    return crossfades.at(-1);
  };
  expect(crossfadeAfter(takesSwapped())).toBe(true);
  expect(crossfadeAfter(compareSet('side'), takesSwapped())).toBe(false);
  expect(crossfadeAfter(takesSwapped())).toBe(false);
  expect(crossfadeAfter(takeChosen('c'))).toBe(true);
  expect(crossfadeAfter(compareSet('ghost'), takeChosen('a'), takeChosen('c'))).toBe(true);
  stop();
});

it('shows what has been read of a video alone, except while the dance before is played', () => {
  const store = change.createAppStore('dark');
  const { reaction } = take('a');
  store.setState({ ...initialState('dark'), leader: dancer, reaction, compare: 'ghost', other: 'b' });
  const onStage = withPartRead(store);
  let seen = onStage.getState();
  const stop = onStage.subscribe((state) => (seen = state));
  const read = leader(60);
  change.apply(store, partReadSet({ leader: read, time: 1.5 }));
  expect(seen).toMatchObject({ reaction: null, compare: 'off', playback: { time: 1.5 } });
  expect(seen.leader).toBe(read);
  change.apply(store, playbackSet({ playing: true }));
  expect(seen).toBe(store.getState());
  change.apply(store, playbackSet({ playing: false }));
  expect(seen.leader).toBe(read);
  change.apply(store, partReadSet(null));
  expect(seen).toMatchObject({ leader: dancer, reaction, compare: 'ghost' });
  stop();
});

it('saves the finished dance as a video while a part of the next one is on the stage', async () => {
  const store = change.createAppStore('dark');
  const { reaction } = take('a');
  const { settings } = reaction.inputs;
  const part = still(30);
  const preview = { motion: part, locked: part };
  store.setState({ leader: dancer, settings, reaction, preview, footLock: false });
  const drawn: Dancers[] = [];
  const stage = stageThatCalls((shown) => drawn.push(shown));
  // A stage for a video has a canvas of its own, which Node has not: the stage itself takes its place.
  const same = (from: Stage) => from as ReturnType<Parameters<typeof openCamera>[4]>;
  await openCamera(stage, store, { width: 640, height: 360 }, 0, same);
  expect(drawn[0]?.reactor).toBe(reaction.motion);
});

it('frames a picture at its moment, to which no time has led', async () => {
  const store = change.createAppStore('dark');
  store.setState({ ...initialState('dark'), leader: dancer });
  const calls: unknown[] = [];
  const stage = new Proxy({} as Stage, {
    get: (_, name) =>
      name === 'then' ? undefined : (...values: unknown[]) => calls.push([name, ...values]) && undefined,
  });
  const same = (from: Stage) => from as ReturnType<Parameters<typeof openCamera>[4]>;
  const camera = await openCamera(stage, store, { width: 640, height: 360 }, 12.5, same);
  await camera.drawAt(12.5);
  expect(calls).toContainEqual(['setTime', 12.5]);
  expect(calls.at(-1)).toEqual(['drawAt', 12.5, 0]);
});
