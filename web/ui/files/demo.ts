import * as v from 'valibot';
import { fetchShipped } from '../../common/fetch';
import { ROLES } from '../../common/role';
import type { Manifest } from '../../model/client';
import type { SolvedMotion } from '../../motion/skeleton/clip';
import { isOf } from '../store/counting';
import type { Files } from '../store/services';
import {
  modelIdentity,
  type LoadedLeader,
  type LoadedSong,
  type ModelIdentity,
  type Reaction,
  type Settings,
} from '../store/reaction';
import { demoChanged, leaderLoaded, readingSet } from '../store/actions/files';
import { reactionAdded, reactionCompleted } from '../store/actions/reaction';
import { countingSet } from '../store/actions/counting';
import { settingsSet } from '../store/actions/settings';
import { apply, type Store, watch } from '../store/store';
import { playbackSet } from '../store/actions/view';
import { withoutUndo } from '../store/history/history';

const text = v.pipe(v.string(), v.minLength(1));
const named = { file: text, name: text, label: text };

/** demo.json: the shipped demo's files, beside it, and what they are called on the page. */
const schema = v.object({
  song: v.object({
    ...named,
    /** A "1" of its count, seconds: the bass of a salsa comes before it, so that it would be found a beat early. */
    one: v.optional(v.number()),
  }),
  leader: v.object(named),
  /** Moment that is shown before anything plays, seconds; the start when it is left out. */
  poster: v.optional(v.pipe(v.number(), v.minValue(0)), 0),
  /** A reaction made beforehand, so that the first click plays while the model is still being loaded. */
  reactor: v.optional(
    v.object({
      file: text,
      /** Id of the model that made it; where that is left out, it is shown with any model. */
      model: v.optional(text),
      label: text,
      settings: v.object({
        /** By stream and layer. */
        guidance: v.record(v.string(), v.record(v.string(), v.number())),
        music: v.number(),
        variety: v.number(),
        seed: v.number(),
        role: v.picklist(ROLES),
      }),
    }),
  ),
});

interface DemoReaders {
  /** The motion in a BVH file that this page wrote. */
  readonly readReactor: (bvh: Uint8Array) => Promise<SolvedMotion>;
  /** Resolves when the manifest has given the settings their defaults. */
  readonly manifest: () => Promise<Manifest>;
}

/** Resolves when nothing of the demo is left to download, or the visitor has asked for a dance before. */
export function demoFetched(store: Store): Promise<void> {
  return new Promise((resolve) => {
    watch(
      store,
      ({ demo, job }) => demo !== 'loading' || job !== null,
      (fetched) => fetched && resolve(),
    );
  });
}

/**
 * Loads the demo as if its files had been dropped, with labels that say they are the demo's. A visitor who has opened
 * files in the meantime keeps them.
 * @param folder address of the demo's folder
 */
export async function loadDemo(store: Store, files: Files, folder: URL, readers: DemoReaders): Promise<void> {
  try {
    const demo = v.parse(schema, await (await fetchShipped(new URL('demo.json', folder))).json());
    const { reactor } = demo;
    const motions = Promise.all([
      fetchShipped(new URL(demo.leader.file, folder)).then(bytesOf),
      reactor ? fetchShipped(new URL(reactor.file, folder)).then(bytesOf) : null,
    ]);
    // The couple comes before the song, and is there without it where it can't be had.
    const songFile = motions
      .then(() => fetchShipped(new URL(demo.song.file, folder)))
      .then((response) => response.blob())
      .catch(() => null);
    const [leaderBytes, reactorBytes] = await motions;
    const motion = reactorBytes && (await readers.readReactor(reactorBytes));
    if (isUntouched(store)) {
      const songLoading = openSong(store, files, songFile, demo);
      const leader = await files.readLeader({
        name: demo.leader.name,
        label: demo.leader.label,
        files: [{ name: demo.leader.name, bytes: leaderBytes }],
        options: {},
      });
      let showing: Promise<void> | null = null;
      if (leader && !store.getState().leader) {
        apply(store, withoutUndo(leaderLoaded(leader)));
        apply(store, playbackSet({ time: demo.poster }));
        // In the same task as its leader, or the page would begin to make a reaction of its own.
        if (reactor && motion) {
          const settings = { ...reactor.settings, height: null, holdHands: true };
          showing = showReaction(store, { ...reactor, motion, leader, settings }, songLoading, readers);
        }
      }
      await songFile;
      apply(store, demoChanged('ready'));
      await Promise.all([showing, songLoading]);
    }
    apply(store, demoChanged('ready'));
  } catch {
    // The page works without its demo; the first-visit block says that it is missing.
    apply(store, demoChanged('missing'));
  }
}

/**
 * Shows the ready-made reaction at once, and completes it with its model and song when those are there. Another model
 * makes one itself, with its own settings.
 */
async function showReaction(
  store: Store,
  made: {
    motion: SolvedMotion;
    leader: LoadedLeader;
    label: string;
    settings: Settings;
    model?: string | undefined;
  },
  songLoading: Promise<LoadedSong | null>,
  readers: DemoReaders,
): Promise<void> {
  const { motion, leader, label, settings } = made;
  const isOfOther = ({ id }: Manifest): boolean => made.model !== undefined && made.model !== id;
  const shown = (song: LoadedSong | null, model?: ModelIdentity): Reaction => ({
    motion,
    latents: null,
    model,
    inputs: { leader, song, shift: 0, settings },
    label,
    seconds: null,
  });
  const { manifest: known } = store.getState();
  if (known && isOfOther(known)) return;
  apply(store, reactionAdded(shown(null)));
  const manifest = await readers.manifest();
  if (isOfOther(manifest)) return;
  if (store.getState().leader === leader) apply(store, withoutUndo(settingsSet(settings)));
  // The visitor may have another leader by now: the take has its song all the same.
  apply(store, reactionCompleted(shown(await songLoading, modelIdentity(manifest))));
}

async function bytesOf(response: Response): Promise<Uint8Array> {
  return new Uint8Array(await response.arrayBuffer());
}

function isUntouched(store: Store): boolean {
  const { song, leader, reading, restoring } = store.getState();
  return !song && !leader && !reading.song && !reading.leader && !restoring;
}

/** Puts the demo's song on the page when it comes; null where it does not, or the visitor has opened something by then. */
async function openSong(
  store: Store,
  files: Files,
  coming: Promise<Blob | null>,
  { song: { name, label, one }, leader }: v.InferOutput<typeof schema>,
): Promise<LoadedSong | null> {
  const reading = { name, fraction: 0 };
  apply(store, readingSet('song', reading));
  const file = await coming;
  const now = store.getState();
  if (now.reading.song !== reading) return null;
  apply(store, readingSet('song', null));
  const isOwn = now.leader !== null && now.leader.label !== leader.label;
  if (!file || isOwn) return null;
  const song = await files.openSong(file, name, label);
  const { song: shown, countings } = store.getState();
  // As a visitor has counted it earlier, it stays.
  if (song && song === shown && one !== undefined && !countings.some((counting) => isOf(counting, song)))
    apply(store, withoutUndo(countingSet({ one })));
  return song;
}
