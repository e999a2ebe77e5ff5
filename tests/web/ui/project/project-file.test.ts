import { strToU8, unzipSync, zipSync } from 'fflate';
import { describe, expect, it } from 'vitest';
import type { Framing } from '../../../../web/common/framing';
import { oneSet } from '../../../../web/ui/store/actions/counting';
import { projectOpened, projectCleared } from '../../../../web/ui/store/actions/project';
import {
  decoderOf,
  type StoredProject,
  storedProject,
  hasVisitorContent,
} from '../../../../web/ui/project/stored-project';
import { checked } from '../../../../web/ui/project/records';
import { readProject, writeProject } from '../../../../web/ui/project/project-file';
import { type StoredFileReaders, Restorer } from '../../../../web/ui/project/restore';
import { modelIdentity } from '../../../../web/ui/store/reaction';
import type { AppState } from '../../../../web/ui/store/state';
import { regionSet, shiftSet, zoomSet } from '../../../../web/ui/store/actions/timeline';
import * as change from '../../support/actions';
import { letterGiven, takeRenamed, takeStarred } from '../../../../web/ui/store/actions/takes';
import { redone, undone, withoutUndo } from '../../../../web/ui/store/history/history';
import { upToDate } from '../../../../web/ui/store/selectors';
import { currentInputs, takeOnStage, takeTitle } from '../../../../web/ui/store/take';
import { small } from '../../support/small-manifest';
import {
  uniformGuidance,
  songData,
  leader,
  leaderFile,
  numbered,
  song,
  still,
} from '../../support/made-state';
import { AppError } from '../../../../web/common/error';

/** Latents of a dance, each of them another number; not all have a short form. */
const latents = (frames: number, from: number): Float32Array =>
  Float32Array.from({ length: Math.ceil(frames / 4) * 6 }, (_, index) => Math.sin(from + index));

/** A page with a song, two leaders and three takes, the first without latents, the second compared with the third. */
function filled(): change.Store {
  const store = change.createAppStore('dark');
  const react = (at: number): void => {
    const inputs = currentInputs(store.getState());
    if (!inputs) throw new Error('no inputs');
    const motion = numbered(inputs.leader.motion.frames, at);
    change.apply(
      store,
      change.reactionAdded(
        {
          motion,
          latents: at === 1 ? null : latents(60, at),
          model: at === 1 ? undefined : modelIdentity(small),
          inputs,
          unfamiliarity: at === 1 ? undefined : at / 2,
          label: null,
          seconds: 2,
        },
        { id: `t${at}`, at: at * 1e6 },
      ),
    );
  };
  change.apply(store, change.manifestLoaded(small, 7));
  change.apply(store, change.leaderLoaded(leader(30, 'früher.bvh')));
  react(1);
  change.apply(
    store,
    change.songLoaded({ ...song(4), file: new Blob(['ID3 song'], { type: 'audio/mpeg' }) }),
  );
  change.apply(store, change.leaderLoaded(leader(60, 'leader_0412.bvh')));
  change.apply(store, change.guidanceSet('coarse', 1.2));
  react(2);
  change.apply(store, change.seedSet(99));
  change.apply(store, change.heightSet(1.7));
  change.apply(store, change.holdHandsSet(false));
  change.apply(store, shiftSet(7));
  react(3);
  change.apply(store, takeStarred('t1'));
  change.apply(store, takeRenamed('t2', 'Softer hands'));
  change.apply(store, letterGiven('t2', 'B'));
  change.apply(store, change.footLockSet(false));
  change.apply(store, oneSet(1.1));
  change.apply(store, regionSet({ from: 0.5, to: 1.75 }));
  change.apply(store, change.playbackSet({ time: 1.5 }));
  return store;
}

const readers: StoredFileReaders = {
  song: ({ name, label, file }) => Promise.resolve({ name, label, file, data: songData(4) }),
  leader: (one) =>
    Promise.resolve({ ...one, file: leaderFile(frames(one.name)), motion: still(frames(one.name)) }),
};
const frames = (name: string): number => (name === 'früher.bvh' ? 30 : 60);

function empty(): change.Store {
  const store = change.createAppStore('dark');
  change.apply(store, change.manifestLoaded(small, 5));
  return store;
}

async function contentOf(kept: StoredProject, state: AppState, how = readers) {
  const restorer = new Restorer(kept);
  await restorer.readPageLeader(how);
  await restorer.readPageSong(how);
  await restorer.readRest(how);
  return { content: restorer.content(state), losses: restorer.losses() };
}

const summary = (state: AppState) => ({
  takes: state.takes.map((take) => ({
    title: takeTitle(take),
    starred: take.starred,
    createdAt: take.createdAt,
    settings: take.reaction.inputs.settings,
    leader: take.reaction.inputs.leader.name,
    song: take.reaction.inputs.song?.name,
    motion: take.reaction.motion,
    latents: take.reaction.latents,
    model: take.reaction.model,
    unfamiliarity: take.reaction.unfamiliarity,
  })),
  onStage: takeOnStage(state)?.id,
  rest: [state.song?.name, state.leader?.name, state.settings, state.other, state.letter, state.footLock],
  countings: state.countings,
  shift: state.shift,
  time: state.playback.time,
  region: [state.playback.region, state.playback.loop],
  takesMade: state.takesMade,
});

const FRAMING: Framing = {
  view: 'follow',
  shot: { target: [0.1, 0.8, -0.2], distance: 3.2, heading: 7, elevation: 0.3 },
  tracked: [0, 0.05],
  ownDistance: true,
  ownHeading: false,
  aspect: 1.6,
};

describe('how a dance is looked at', () => {
  const readAgain = async (framing: unknown, region: unknown) => {
    const state = filled().getState();
    const kept = storedProject(state, FRAMING);
    const { page } = { ...kept, page: { ...kept.page, framing, region } } as StoredProject;
    const { project } = readProject(await writeProject({ ...kept, page }));
    const { content } = await contentOf(project, empty().getState());
    return { framing: project.page.framing, region: content.playback?.region, camera: content.camera };
  };

  it('is restored: the camera, and the part that is looped', async () => {
    const region = { from: 0.5, to: 1.75 };
    expect(await readAgain(FRAMING, region)).toEqual({ framing: FRAMING, region, camera: 'follow' });
  });

  it.each([
    ['a camera beyond the floor', { ...FRAMING, tracked: [1e9, 0] }],
    ['a camera without a place', { ...FRAMING, shot: { ...FRAMING.shot, distance: Number.MAX_VALUE } }],
    ['an unknown view', { ...FRAMING, view: 'inside' }],
    ['nothing', null],
  ])('%s is left out', async (_, framing) => {
    expect(await readAgain(framing, null)).toEqual({ framing: null, region: null, camera: undefined });
  });

  it.each([
    ['backwards', { from: 1.5, to: 0.5 }],
    ['after the end', { from: 1.5, to: 60 }],
    ['without an end', { from: 1.5 }],
  ])('a part that is %s is left out', async (_, region) => {
    expect((await readAgain(FRAMING, region)).region).toBeNull();
  });

  it('is stored without the camera where the page shows no couple', () => {
    expect(storedProject(empty().getState(), FRAMING).page.framing).toBeNull();
  });
});

describe('a project', () => {
  it('restores everything from its file, bit by bit', async () => {
    const before = filled().getState();
    const kept = readProject(await writeProject(storedProject(before))).project;
    const store = empty();
    const { content, losses } = await contentOf(kept, store.getState());
    change.apply(store, projectOpened(content));
    expect(summary(store.getState())).toEqual(summary(before));
    expect(losses).toEqual([]);
    expect(await store.getState().song?.file.text()).toBe('ID3 song');
    expect(store.getState().song?.file.type).toBe('audio/mpeg');
    // The same files are the same objects, so that nothing is made anew.
    expect(store.getState().reaction?.inputs).toEqual(currentInputs(store.getState()));
    expect(store.getState().reaction?.inputs.leader).toBe(store.getState().leader);
  });

  it('holds a leader of many files, as a dance with the figures of a folder is', async () => {
    const bytes = new TextEncoder().encode('glTF');
    const files = ['walk.vrma', ...Array.from({ length: 12 }, (_, i) => `figure-${i}.vrm`)].map((name) => ({
      name,
      bytes,
    }));
    const kept = storedProject(filled().getState());
    const leaders = kept.leaders.map((one) => ({ ...one, name: 'walk.vrma', files }));
    const { project, losses } = readProject(await writeProject({ ...kept, leaders }));
    expect(losses).toEqual([]);
    expect(project.leaders.map((one) => one.files)).toEqual(leaders.map((one) => one.files));
  });

  it('holds a leader beside whose motion an empty file was dropped', async () => {
    const files = [
      { name: 'dance.gltf', bytes: new TextEncoder().encode('{}') },
      { name: 'dance.bin', bytes: new Uint8Array() },
    ];
    const kept = storedProject(filled().getState());
    const leaders = kept.leaders.map((one) => ({ ...one, name: 'dance.gltf', files }));
    const { project, losses } = readProject(await writeProject({ ...kept, leaders }));
    expect(losses).toEqual([]);
    expect(project.leaders.map((one) => one.files.map(({ name }) => name))).toEqual(
      leaders.map(() => ['dance.gltf', 'dance.bin']),
    );
  });

  it('that is too large to be read again is not written', async () => {
    const kept = storedProject(filled().getState());
    const files = [1, 2].map((part) => ({ name: `${part}.bvh`, bytes: new Uint8Array(6e8) }));
    const leaders = kept.leaders.map((one) => ({ ...one, files }));
    await expect(writeProject({ ...kept, leaders })).rejects.toMatchObject({ code: 'too-large' });
  });

  it('holds files that other programs open', async () => {
    const files = unzipSync(await writeProject(storedProject(filled().getState())));
    expect(Object.keys(files).sort()).toEqual([
      'leaders/1-leader-0412.bvh',
      'leaders/2-fruher.bvh',
      'project.json',
      'songs/1-descarga.mp3',
      'takes/1-latents.f32',
      'takes/1.f32',
      'takes/2-latents.f32',
      'takes/2.f32',
      'takes/3.f32',
    ]);
    expect(files['takes/1.f32']?.byteLength).toBe(4 * (66 + 60 * 157));
    expect(files['takes/1-latents.f32']?.byteLength).toBe(4 * 15 * 6);
  });

  it('replaces what is there, and undo brings that back', async () => {
    const kept = readProject(await writeProject(storedProject(filled().getState()))).project;
    const store = filled();
    const before = store.getState();
    const { content } = await contentOf(kept, before);
    change.apply(store, zoomSet({ from: 0.5, to: 1.75 }));
    change.apply(store, projectOpened(content));
    expect(store.getState().zoom).toBeNull();
    const opened = summary(store.getState());
    expect(store.getState().takes[0]).not.toBe(before.takes[0]);
    change.apply(store, undone());
    expect(summary(store.getState())).toEqual(summary(before));
    expect(store.getState().takes).toBe(before.takes);
    change.apply(store, redone());
    expect(summary(store.getState())).toEqual(opened);
  });

  it('clearing it empties the page, and undo brings it back', () => {
    const store = filled();
    const before = store.getState();
    change.apply(store, projectCleared(small, 3));
    expect(store.getState()).toMatchObject({
      takes: [],
      leader: null,
      song: null,
      shift: 0,
      reaction: null,
      firstVisit: true,
      zoom: null,
      playback: { time: 0, region: null },
    });
    expect(store.getState().settings?.seed).toBe(3);
    expect(hasVisitorContent(store.getState())).toBe(false);
    // As the demo does it.
    change.apply(store, withoutUndo(change.leaderLoaded(leader(90, 'demo.bvh'))));
    change.apply(store, undone());
    expect(summary(store.getState())).toEqual(summary(before));
    expect(upToDate(store.getState())).toBe(true);
  });
});

describe('latents', () => {
  const latentsIn = async (kept: StoredProject, state: AppState) =>
    (await contentOf(kept, state)).content.takes?.map(({ reaction }) => reaction.latents);

  it('are left out where the model has another decoder, whatever its name', async () => {
    const kept = storedProject(filled().getState());
    const { decode, ...graphs } = small.graphs;
    const { wasm, webgpu } = decode.files;
    const tuned = { ...decode, files: { wasm: { ...wasm, sha256: '1'.repeat(64) }, webgpu } };
    const store = change.createAppStore('dark');
    change.apply(store, change.manifestLoaded({ ...small, graphs: { ...graphs, decode: tuned } }, 5));
    expect(decoderOf(store.getState().manifest!)).not.toBe(decoderOf(small));
    expect(await latentsIn(kept, store.getState())).toEqual([null, null, null]);
    expect(await latentsIn(kept, empty().getState())).toEqual([latents(60, 3), latents(60, 2), null]);
  });

  it('are missing from takes that were stored without them, which open all the same', async () => {
    const files = unzipSync(await writeProject(storedProject(filled().getState())));
    const manifest = JSON.parse(new TextDecoder().decode(files['project.json'])) as {
      motions: Record<string, unknown>[];
    };
    for (const motion of manifest.motions) delete motion['latents'];
    const bytes = zipSync({ ...files, 'project.json': strToU8(JSON.stringify(manifest)) });
    expect(await latentsIn(readProject(bytes).project, empty().getState())).toEqual([null, null, null]);
  });
});

describe('a part that cannot be read any more', () => {
  const kept = () => storedProject(filled().getState());

  it('removes only its own takes when it is a leader', async () => {
    const { content, losses } = await contentOf(kept(), empty().getState(), {
      ...readers,
      leader: (one) => (one.name === 'früher.bvh' ? Promise.resolve(null) : readers.leader(one)),
    });
    expect(content.takes?.map(takeTitle)).toEqual(['Take 3', 'Softer hands']);
    expect(losses).toEqual(['The leader früher.bvh could not be read again; its take is left out.']);
    expect(content.leader?.name).toBe('leader_0412.bvh');
  });

  it('leaves its takes when it is a song', async () => {
    const { content, losses } = await contentOf(kept(), empty().getState(), {
      ...readers,
      song: () => Promise.resolve(null),
    });
    expect(content.takes).toHaveLength(3);
    expect(content.song).toBeNull();
    expect(losses[0]).toContain('Descarga.mp3');
  });

  it('is replaced by the page’s own value when it is a setting', async () => {
    const before = kept();
    const takes = before.takes.map((take) => ({
      ...take,
      inputs: { settings: { guidance: { upper: { coarse: 'much', fine: 0.6 } }, seed: null, old: 1 } },
    }));
    const { content } = await contentOf({ ...before, takes }, empty().getState());
    expect(content.takes?.[0]?.reaction.inputs.settings).toEqual({
      guidance: { ...uniformGuidance(0, 0), upper: { coarse: 0, fine: 0.6 } },
      music: 2,
      variety: 1,
      seed: 5,
      role: 'reactor',
      height: null,
      holdHands: true,
    });
  });
});

const whole = writeProject(storedProject(filled().getState()));
const changed = async (alter: (files: Record<string, Uint8Array>) => void): Promise<Uint8Array> => {
  const files = unzipSync(await whole);
  alter(files);
  return zipSync(files);
};
const json = async (alter: (manifest: Record<string, unknown>) => void): Promise<Uint8Array> =>
  changed((files) => {
    const manifest = JSON.parse(new TextDecoder().decode(files['project.json'])) as Record<string, unknown>;
    alter(manifest);
    files['project.json'] = strToU8(JSON.stringify(manifest));
  });

/** One of the entries of project.json. */
type Entries = Record<string, unknown>[];
const entry = (list: string, at: number, change: object) =>
  json((manifest) => void Object.assign((manifest[list] as Entries)[at]!, change));

/** A project whose takes and page have this value for one of the settings. */
const withSetting = (name: string, value: unknown): Promise<Uint8Array> =>
  json(({ takes, page }: Record<string, unknown>) => {
    for (const { inputs } of [...(takes as Entries), page] as { inputs: { settings: Entries[0] } }[])
      inputs.settings[name] = value;
  });

describe('what does not fit', () => {
  it.each<[string, () => Promise<Uint8Array>, readonly number[], RegExp]>([
    ['a take without a name', () => entry('takes', 0, { id: 5 }), [2, 1], /left out: 1 take\./],
    [
      'a take twice',
      () =>
        json(
          (manifest) => void (manifest['takes'] as Entries).push({ ...(manifest['takes'] as Entries)[0] }),
        ),
      [3, 2, 1],
      /1 take\./,
    ],
    [
      'a take of a date that no calendar has',
      () => entry('takes', 0, { createdAt: 1e300 }),
      [2, 1],
      /1 take\./,
    ],
    [
      'half a motion',
      () => changed((files) => (files['takes/2.f32'] = new Uint8Array(100))),
      [3, 1],
      /1 motion, 1 take\./,
    ],
    [
      'a motion of a billion frames',
      () => entry('motions', 0, { frames: 1e9 }),
      [2, 1],
      /1 motion, 1 take\./,
    ],
    [
      'a motion in a file with the name of a method',
      () => entry('motions', 0, { file: '__proto__' }),
      [2, 1],
      /1 motion, 1 take\./,
    ],
    [
      'a motion whose root is not at its pelvis',
      () =>
        changed((files) => {
          const motion = Float32Array.from(new Float32Array(files['takes/2.f32']!.slice().buffer));
          // After the offsets of 22 joints comes the root.
          motion[22 * 3]! += 0.1;
          files['takes/2.f32'] = new Uint8Array(motion.buffer);
        }),
      [3, 1],
      /1 motion, 1 take\./,
    ],
    ['no song', () => changed((files) => delete files['songs/1-descarga.mp3']), [3, 2, 1], /1 song\./],
  ])('%s is left out and said', async (_, make, numbers, words) => {
    const { project, losses } = readProject(await make());
    expect(losses.join(' ')).toMatch(words);
    const { content } = await contentOf(project, empty().getState());
    expect(content.takes?.map(({ number }) => number)).toEqual(numbers);
  });

  it('are latents of another number, without which a take is whole', async () => {
    const bytes = await changed((files) => (files['takes/1-latents.f32'] = new Uint8Array(80)));
    const { content } = await contentOf(readProject(bytes).project, empty().getState());
    expect(content.takes?.map(({ reaction }) => reaction.latents?.length)).toEqual([
      undefined,
      90,
      undefined,
    ]);
  });

  it.each([1e12, -5, 2.5])(
    'is the seed %d, which becomes the nearest that the model takes, and that is said',
    async (seed) => {
      const { content, losses } = await contentOf(
        readProject(await withSetting('seed', seed)).project,
        empty().getState(),
      );
      const nearest = Math.min(0xffffffff, Math.max(0, Math.round(seed)));
      expect(content.settings?.seed).toBe(nearest);
      expect(content.takes?.map(({ reaction }) => reaction.inputs.settings.seed)).toEqual([
        nearest,
        nearest,
        nearest,
      ]);
      expect(losses).toEqual([expect.stringContaining('settings of 3 takes are outside')]);
    },
  );

  it('is a number of steps, as it was a setting once, and nothing is said', async () => {
    const before = await contentOf(readProject(await whole).project, empty().getState());
    const after = await contentOf(readProject(await withSetting('steps', 10)).project, empty().getState());
    expect(after.content.settings).toEqual(before.content.settings);
    const settings = ({ content }: typeof before) =>
      content.takes?.map(({ reaction }) => reaction.inputs.settings);
    expect(settings(after)).toEqual(settings(before));
    expect(after.losses).toEqual([]);
  });

  it('is a motion of another length than its leader', async () => {
    const { content, losses } = await contentOf(readProject(await whole).project, empty().getState(), {
      ...readers,
      leader: (one) => Promise.resolve({ ...one, file: leaderFile(60), motion: still(60) }),
    });
    expect(content.takes?.map(({ number }) => number)).toEqual([3, 2]);
    expect(losses).toEqual(['A take of another length than the leader is left out.']);
  });

  it('is a page without its leader, which gets that of the newest take', async () => {
    const bytes = await changed((files) => delete files['leaders/1-leader-0412.bvh']);
    const { project, losses } = readProject(bytes);
    expect(losses.join(' ')).toContain('1 leader, 2 takes');
    const { content } = await contentOf(project, empty().getState());
    expect(content).toMatchObject({ leader: { name: 'früher.bvh' }, takes: [{ number: 1 }] });
    expect(content.reaction).toBe(content.takes?.[0]?.reaction);
  });

  it('is a leader beyond the hundredth', () => {
    const files = [{ name: 'a.bvh', bytes: new Uint8Array(3) }];
    const ids = Array.from({ length: 1000 }, (_, i) => `${i}`);
    const kept = storedProject(filled().getState());
    const { project, losses } = checked({
      ...kept,
      leaders: ids.map((id) => ({ id, name: id, label: null, files, options: {} })),
      takes: ids.map((id) => ({ ...kept.takes[0]!, id, leader: id, createdAt: Number(id) })),
    });
    expect(project.leaders).toHaveLength(100);
    expect(project.takes[0]?.id).toBe('999');
    expect(losses.join()).toContain('900 takes');
  });
});

describe('a broken project', () => {
  it.each<[string, () => Promise<Uint8Array>, string, RegExp]>([
    [
      'that is something else',
      () => Promise.resolve(strToU8('%PDF-1.4')),
      'not-a-project',
      /not a ReactDance project/,
    ],
    ['that is empty', () => Promise.resolve(new Uint8Array()), 'not-a-project', /not a ReactDance project/],
    ['that is cut off', async () => (await whole).slice(0, 4000), 'damaged-project', /cut off/],
    [
      'without project.json',
      () => changed((files) => delete files['project.json']),
      'not-a-project',
      /no project.json/,
    ],
    [
      'with a torn project.json',
      () => changed((files) => (files['project.json'] = strToU8('{"format": '))),
      'damaged-project',
      /no JSON/,
    ],
    [
      'from a newer page',
      () => json((manifest) => void Object.assign(manifest, { version: 3 })),
      'newer-project',
      /newer version/,
    ],
    [
      'with a list that is none',
      () => json((manifest) => void Object.assign(manifest, { takes: 5 })),
      'damaged-project',
      /takes: Invalid type/,
    ],
    [
      'without song and leader',
      () => json((manifest) => void Object.assign(manifest, { songs: [], leaders: [] })),
      'damaged-project',
      /no song and no leader .* left out: 3 takes/,
    ],
  ])('%s says so', async (_, make, code, words) => {
    const bytes = await make();
    let caught: unknown;
    try {
      readProject(bytes);
    } catch (error) {
      caught = error;
    }
    expect(caught).toBeInstanceOf(AppError);
    expect(caught).toMatchObject({ code, message: words, hint: expect.stringMatching(/\w/) as string });
  });
});
