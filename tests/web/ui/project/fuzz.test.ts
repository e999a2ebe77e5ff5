import { strFromU8, strToU8, unzipSync, zipSync } from 'fflate';
import { expect, test } from 'vitest';
import { readProject, writeProject } from '../../../../web/ui/project/project-file';
import { checked, type FoundProject } from '../../../../web/ui/project/records';
import { Restorer } from '../../../../web/ui/project/restore';
import { type StoredProject, storedProject } from '../../../../web/ui/project/stored-project';
import { currentInputs } from '../../../../web/ui/store/take';
import * as change from '../../support/actions';
import { fuzz } from '../../support/hostile/fuzz';
import { damagedBytes, damagedJson, type Random } from '../../support/hostile/mutations';
import { leader, leaderFile, numbered, song, songData } from '../../support/made-state';
import { small } from '../../support/small-manifest';

const FRAMES = 8;

/** A project with a song, two leaders and three takes, short so that each case is fast. */
function project(): StoredProject {
  const store = page();
  change.apply(store, change.songLoaded(song(2)));
  for (const number of [1, 2, 3]) {
    if (number < 3) change.apply(store, change.leaderLoaded(leader(FRAMES, `${number}.bvh`)));
    change.apply(store, change.seedSet(number));
    const inputs = currentInputs(store.getState())!;
    const latents = Float32Array.from({ length: 12 }, (_, i) => Math.sin(i));
    const reaction = { motion: numbered(FRAMES, number), latents, inputs, label: null, seconds: 1 };
    change.apply(store, change.reactionAdded(reaction, { id: `take ${number}`, at: number * 1e6 }));
  }
  return storedProject(store.getState());
}

function page(): change.Store {
  const store = change.createAppStore('dark');
  change.apply(store, change.manifestLoaded(small, 7));
  return store;
}

/** What is accepted can be restored, and is what a page could have stored. */
async function meaningful({ project, losses }: ReturnType<typeof checked>): Promise<void> {
  for (const { motion } of project.motions) {
    expect(motion.positions).toHaveLength(motion.frames * 66);
    for (const values of [motion.offsets, motion.root, motion.rotations, motion.positions])
      expect(values.every((value) => Math.abs(value) < 60)).toBe(true);
  }
  const restorer = new Restorer(project);
  await restorer.readRest({
    song: ({ name, label, file }) => Promise.resolve({ name, label, file, data: songData(2) }),
    leader: (one) => Promise.resolve({ ...one, file: leaderFile(FRAMES), motion: leader(FRAMES).motion }),
  });
  const store = page();
  const content = restorer.content(store.getState());
  store.setState(content);
  for (const { reaction, name, number } of content.takes ?? []) {
    const { seed, music, variety, guidance } = reaction.inputs.settings;
    expect(Number.isInteger(seed) && seed >= 0 && seed < 2 ** 32).toBe(true);
    for (const value of [music, variety, ...Object.values(guidance).flatMap((row) => Object.values(row))])
      expect(Math.abs(value)).toBeLessThanOrEqual(4);
    expect(reaction.motion.frames).toBe(FRAMES);
    expect((name ?? '').length).toBeLessThanOrEqual(60);
    expect(Number.isInteger(number)).toBe(true);
  }
  // It can be stored again, and all of it fits then.
  expect(checked(found(storedProject(store.getState()))).losses).toEqual([]);
  expect([...losses, ...restorer.losses()].every((loss) => loss.endsWith('.'))).toBe(true);
}

/** A stored project as it lies in the database. */
function found({ songs, ...rest }: StoredProject): FoundProject {
  return {
    ...rest,
    songs: songs.map(({ file, ...one }) => ({ ...one, type: file.type, bytes: new Uint8Array(3) })),
  };
}

test('damaged records are left out, and what is restored can be used', { timeout: 600_000 }, async () => {
  const whole = found(project());
  const later: (() => Promise<void>)[] = [];
  fuzz(
    (random) => ({ ...(damagedJson(withoutArrays(whole), random) as object) }),
    (json) => checked(withArrays(json, whole)),
    (read) => void later.push(() => meaningful(read)),
  );
  for (const check of later) await check();
});

test(
  'a damaged project file is refused in a sentence, or opens without what does not fit',
  { timeout: 600_000 },
  async () => {
    const files = unzipSync(await writeProject(project()));
    const zip = zipSync(files, { level: 0 });
    const manifest: unknown = JSON.parse(strFromU8(files['project.json']!));
    const later: (() => Promise<void>)[] = [];
    const { refused } = fuzz(
      (random) => damagedArchive(zip, files, manifest, random),
      readProject,
      (read) => void later.push(() => meaningful(read)),
    );
    expect(refused).toBeGreaterThan(0);
    expect(later.length).toBeGreaterThan(0);
    for (const check of later) await check();
  },
);

function damagedArchive(
  zip: Uint8Array,
  files: Readonly<Record<string, Uint8Array>>,
  manifest: unknown,
  random: Random,
): Uint8Array {
  const names = Object.keys(files);
  const name = names[random(names.length)]!;
  switch (random(3)) {
    case 0:
      return damagedBytes(zip, random);
    case 1:
      return zipSync({ ...files, [name]: damagedBytes(files[name]!, random) }, { level: 0 });
    default: {
      const json = JSON.stringify(damagedJson(manifest, random)) as string | undefined;
      return zipSync({ ...files, 'project.json': strToU8(json ?? '') }, { level: 0 });
    }
  }
}

/** The records with their arrays named instead of included, so that damage falls on all other fields. */
function withoutArrays(whole: FoundProject): unknown {
  return JSON.parse(
    JSON.stringify(whole, (_, value: unknown) =>
      ArrayBuffer.isView(value) ? `array ${value.byteLength}` : value,
    ),
  );
}

/** The records with arrays of the named lengths in their places. */
function withArrays(json: object, whole: FoundProject): FoundProject {
  const arrays = new Map<string, ArrayBufferView>();
  const visit = (value: unknown): void => {
    if (ArrayBuffer.isView(value)) arrays.set(`array ${value.byteLength}`, value);
    else if (value !== null && typeof value === 'object') Object.values(value).forEach(visit);
  };
  visit(whole);
  const restored = (value: unknown, depth = 0): unknown => {
    if (typeof value === 'string') return arrays.get(value) ?? value;
    if (value === null || typeof value !== 'object' || depth > 30) return value;
    if (Array.isArray(value)) return value.map((part) => restored(part, depth + 1));
    return Object.fromEntries(Object.entries(value).map(([key, part]) => [key, restored(part, depth + 1)]));
  };
  const { songs, leaders, motions, takes, page } = restored(json) as Record<keyof FoundProject, unknown>;
  const list = (part: unknown): unknown[] => (Array.isArray(part) ? part : []);
  return { songs: list(songs), leaders: list(leaders), motions: list(motions), takes: list(takes), page };
}
