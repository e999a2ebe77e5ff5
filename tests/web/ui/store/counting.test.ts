import { describe, expect, it } from 'vitest';
import { countingSet, oneSet } from '../../../../web/ui/store/actions/counting';
import { leaderLoaded, songLoaded } from '../../../../web/ui/store/actions/files';
import { manifestLoaded } from '../../../../web/ui/store/actions/model';
import {
  barAt,
  barBeside,
  beatBeside,
  type CountedBeats,
  countedBeats,
  placeOf,
  snapped,
  tempoText,
} from '../../../../web/ui/store/counting';
import { redone, undone } from '../../../../web/ui/store/history/history';
import { apply, createAppStore, type Store } from '../../../../web/ui/store/store';
import { musicBeats } from '../../../../web/ui/store/song-shift';
import { small } from '../../support/small-manifest';
import { leader, rhythm, song } from '../../support/made-state';

const times = (count: number, every = 0.5, begin = 0.5): number[] =>
  Array.from({ length: count }, (_, index) => begin + index * every);
const four: CountedBeats = { times: times(20), beatsPerBar: 4, first: 0 };

/** A page with a song of 20 beats, 120 a minute, the first at 0.5 s and a "1" at the third. */
function page(): Store {
  const store = createAppStore('dark');
  store.setState({ leader: leader(300), song: song(12, { rhythm: rhythm(times(20), { first: 2 }) }) });
  return store;
}

const count = (store: Store, time: number): number | undefined =>
  barAt(countedBeats(store.getState()), time)?.count;

describe('bar and count', () => {
  it('counts eight beats in two bars', () => {
    expect(barAt(four, 0.4)).toBeNull();
    expect(barAt(four, 0.5)).toEqual({ bar: 1, count: 1 });
    expect(barAt(four, 2.2)).toEqual({ bar: 1, count: 4 });
    expect(barAt(four, 2.5)).toEqual({ bar: 2, count: 5 });
    expect(barAt(four, 4.5)).toEqual({ bar: 3, count: 1 });
  });

  it('counts six in bars of three, and upbeats before the first bar', () => {
    const three: CountedBeats = { times: times(20), beatsPerBar: 3, first: 2 };
    expect([0, 1, 2, 4, 5, 7, 8].map((index) => placeOf(three, index))).toEqual([
      { bar: 0, count: 5 },
      { bar: 0, count: 6 },
      { bar: 1, count: 1 },
      { bar: 1, count: 3 },
      { bar: 2, count: 4 },
      { bar: 2, count: 6 },
      { bar: 3, count: 1 },
    ]);
  });

  it('ends with the last beat', () => {
    expect(barAt(four, 10.4)).toEqual({ bar: 5, count: 4 });
    expect(barAt(four, 10.5)).toBeNull();
    const one: CountedBeats = { times: [2], beatsPerBar: 4, first: 0 };
    expect(barAt(one, 2.4)).toEqual({ bar: 1, count: 1 });
    expect(barAt(one, 2.6)).toBeNull();
    expect(barAt({ times: [], beatsPerBar: 4, first: 0 }, 1)).toBeNull();
  });
});

describe('times and beats', () => {
  it('snap to the nearest beat, and to nothing where the song has none', () => {
    expect(snapped(four, 1.7)).toBe(1.5);
    expect(snapped(four, 1.8)).toBe(2);
    expect(snapped(four, 0.1)).toBe(0.1);
    expect(snapped(four, 0.3)).toBe(0.5);
    expect(snapped(four, 11)).toBe(11);
    expect(snapped({ times: [], beatsPerBar: 4, first: 0 }, 3.3)).toBe(3.3);
  });

  it('lead to the beat beside them', () => {
    expect([beatBeside(four, 1.5, 1), beatBeside(four, 1.5, -1), beatBeside(four, 1.7, -1)]).toEqual([
      2, 1, 1.5,
    ]);
    expect([beatBeside(four, 0.5, -1), beatBeside(four, 10, 1)]).toEqual([null, null]);
  });
});

describe('the count of a song', () => {
  it('begins where it was found, and where the visitor says, however the song is shifted', () => {
    const store = page();
    expect([count(store, 0.5), count(store, 1.5)]).toEqual([7, 1]);
    apply(store, oneSet(2.6));
    expect([count(store, 1.5), count(store, 2.5)]).toEqual([7, 1]);
    store.setState({ shift: 30 });
    expect(count(store, 3.5)).toBe(1);
    apply(store, oneSet(4.1));
    store.setState({ shift: 0 });
    expect(count(store, 3)).toBe(1);
  });

  it('goes at half or double the tempo, with the "1" in its place', () => {
    const store = page();
    const tempo = (): string => tempoText(store.getState().song!, store.getState().countings);
    expect(tempo()).toBe('120 BPM');
    apply(store, oneSet(2));
    apply(store, countingSet({ rate: 0.5 }));
    expect(tempo()).toBe('60 BPM');
    expect(countedBeats(store.getState()).times.slice(0, 3)).toEqual([1, 2, 3]);
    expect([count(store, 2), count(store, 3)]).toEqual([1, 2]);
    apply(store, countingSet({ rate: 2 }));
    expect(tempo()).toBe('240 BPM');
    expect([count(store, 2), count(store, 2.25)]).toEqual([1, 2]);
    apply(store, countingSet({ beatsPerBar: 3 }));
    expect([count(store, 3.25), count(store, 3.5)]).toEqual([6, 1]);
    apply(store, countingSet(null));
    expect([tempo(), count(store, 1.5)]).toEqual(['120 BPM', 1]);
  });

  it('is undone and redone, and comes back with its song', () => {
    const store = page();
    apply(store, oneSet(2.5));
    apply(store, undone());
    expect(count(store, 1.5)).toBe(1);
    apply(store, redone());
    expect(count(store, 2.5)).toBe(1);
    const before = store.getState().song!;
    apply(store, songLoaded({ ...song(8), name: 'other.mp3' }));
    expect(count(store, 0)).toBe(1);
    apply(store, songLoaded(before));
    expect(count(store, 2.5)).toBe(1);
  });

  it('is nothing without a steady beat', () => {
    const store = page();
    const silent = song(8, { rhythm: rhythm([]) });
    store.setState({ song: silent });
    apply(store, oneSet(2));
    apply(store, countingSet({ rate: 2 }));
    expect(store.getState().countings).toEqual([]);
    expect(countedBeats(store.getState()).times).toEqual([]);
    expect(tempoText(silent, [])).toBe('no steady beat');
  });
});

it('a tempo says how sure and how steady it is', () => {
  const text = (more: Parameters<typeof rhythm>[1]) =>
    tempoText(song(12, { rhythm: rhythm(times(20), more) }), []);
  expect(text({})).toBe('120 BPM');
  expect(text({ slowest: 118, fastest: 123 })).toBe('120 BPM');
  expect(text({ slowest: 99.6, fastest: 135.2 })).toBe('100–135 BPM');
  expect(text({ sure: false })).toBe('about 120 BPM');
  const changing = song(12, { rhythm: rhythm(times(20), { slowest: 99.6, fastest: 135.2 }) });
  const twice = { song: changing.name, bytes: changing.file.size, beatsPerBar: 4, rate: 2, one: 0 } as const;
  expect(tempoText(changing, [twice])).toBe('199–270 BPM');
  expect(tempoText(changing, [{ ...twice, bytes: twice.bytes + 1 }]), 'another song').toBe('100–135 BPM');
});

it('a bar on and back is the start of a bar, and at the ends that of the dance', () => {
  const store = createAppStore('dark');
  apply(store, manifestLoaded(small, 7));
  apply(store, leaderLoaded(leader(300)));
  expect(barBeside(store.getState(), 4, -1)).toBe(3);
  apply(store, songLoaded(song(10)));
  const state = store.getState();
  const [first = NaN, , , , second = NaN] = musicBeats(state);
  expect(second).toBeGreaterThan(first);
  expect(barBeside(state, first, 1)).toBe(second);
  expect(barBeside(state, first + 0.2, 1)).toBe(second);
  expect(barBeside(state, second, -1)).toBe(first);
  expect(barBeside(state, second - 0.2, -1)).toBe(first);
  expect(barBeside(state, first, -1)).toBe(0);
  expect(barBeside(state, 9.99, 1)).toBe(10);
});
