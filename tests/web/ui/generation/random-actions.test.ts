import { afterEach, beforeEach, expect, it, vi } from 'vitest';
import { Generation } from '../../../../web/ui/generation/generation';
import { projectCleared } from '../../../../web/ui/store/actions/project';
import { takeChosen, takeDeleted } from '../../../../web/ui/store/actions/takes';
import { redone, undone } from '../../../../web/ui/store/history/history';
import { danceDuration } from '../../../../web/ui/store/selectors';
import type { AppState } from '../../../../web/ui/store/state';
import * as change from '../../support/actions';
import { randomOf, type Random } from '../../support/hostile/mutations';
import { leader, song, still } from '../../support/made-state';
import { ManualGenerator, result } from '../../support/manual-generator';
import { small } from '../../support/small-manifest';

/** Each page is another order of actions, the same in each run. */
const PAGES = 20;
const ACTIONS = 150;

beforeEach(() => void vi.useFakeTimers({ now: 0 }));
afterEach(() => void vi.useRealTimers());

/** What visitors and the model do in any order; each is picked by its name, which a failure tells. */
function actionsOn(store: change.Store, generation: Generation, model: ManualGenerator, random: Random) {
  const answered = new Set<unknown>();
  const asked = () => model.calls.find((call) => !answered.has(call) && !call.options.signal?.aborted);
  const anyTake = (): string => {
    const { takes } = store.getState();
    return takes[random(takes.length || 1)]?.id ?? 'none';
  };
  const does =
    (make: () => change.Change): (() => void) =>
    () => {
      change.apply(store, make());
    };
  return {
    leader: does(() => change.leaderLoaded(leader(60 + 30 * random(3)))),
    song: does(() => change.songLoaded(song(2 + random(3)))),
    beginReading: does(() => change.readingSet('song', { name: 'a.mp3', fraction: 0 })),
    endReading: does(() => change.readingSet('song', null)),
    seed: does(() => change.seedSet(random(5))),
    coarse: does(() => change.guidanceSet('coarse', random(5) / 10)),
    swap: does(() => change.rolesSwapped()),
    choose: does(() => takeChosen(anyTake())),
    remove: does(() => takeDeleted(anyTake())),
    undo: does(() => undone()),
    redo: does(() => redone()),
    play: does(() => change.playbackSet({ time: random(5) })),
    model: does(() => change.modelOpened(small, 3)),
    clear: does(() => projectCleared(small, 3)),
    cancel: generation.cancel,
    generate: generation.generate,
    answer: () => {
      const call = asked();
      answered.add(call);
      call?.answer(result(call.request.leader.frames));
    },
    preview: () => {
      const call = asked();
      void call?.options.onPreview?.({
        motion: still(24),
        locked: still(24),
        from: call.request.leader.frames - 24,
      });
    },
  };
}

/** What holds after each of them. */
function expectMeaningful(state: AppState): void {
  const { leader, settings, reaction, preview, job, takes, playback } = state;
  if (reaction) {
    expect(reaction.inputs.leader).toBe(leader);
    expect(reaction.inputs.settings.role).toBe(settings?.role);
  }
  if (preview) {
    expect(job).not.toBeNull();
    expect(preview.motion.frames).toBe(leader?.motion.frames);
  }
  expect(new Set(takes.map(({ id }) => id)).size).toBe(takes.length);
  expect(new Set(takes.map((take) => take.reaction)).size).toBe(takes.length);
  expect(playback.time).toBeLessThanOrEqual(danceDuration(state));
}

it('whatever is done in whichever order, the dance on the stage is one to its leader, in its role', async () => {
  for (let page = 0; page < PAGES; page++) {
    const random = randomOf(page);
    const store = change.createAppStore('dark');
    change.apply(store, change.manifestLoaded(small, 7));
    const model = new ManualGenerator();
    const generation = new Generation(store, () => Promise.resolve(model.generator));
    const actions = Object.entries(actionsOn(store, generation, model, random));
    const done: string[] = [];
    try {
      for (let count = 0; count < ACTIONS; count++) {
        const [name, act] = actions[random(actions.length)]!;
        done.push(name);
        act();
        await vi.advanceTimersByTimeAsync(0);
        expectMeaningful(store.getState());
      }
    } catch (error) {
      throw new Error(`Page ${page} after ${done.slice(-12).join(', ')}`, { cause: error });
    } finally {
      generation.dispose();
    }
  }
});
