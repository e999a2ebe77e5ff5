import { describe, expect, it } from 'vitest';
import * as select from '../../../../web/ui/store/selectors';
import type { Settings } from '../../../../web/ui/store/reaction';
import type { AppState } from '../../../../web/ui/store/state';
import { initialState } from '../../../../web/ui/store/store';
import { small } from '../../support/small-manifest';
import { NO_RHYTHM } from '../../../../web/audio/rhythm/rhythm';
import { uniformGuidance, leader, rhythm, song, still } from '../../support/made-state';

const settings: Settings = {
  guidance: uniformGuidance(1.2, 0.6),
  music: 2,
  variety: 1,
  seed: 1204,
  role: 'reactor',
  height: null,
  holdHands: true,
};
const state = (more: Partial<AppState>): AppState => ({
  ...initialState('dark'),
  manifest: small,
  settings,
  ...more,
});

describe('the inputs of the next reaction', () => {
  it('are null without a leader, or while a file is still being read', () => {
    expect(select.readyInputs(state({ song: song(5) }))).toBeNull();
    const reading = { song: { name: 'a.mp3', fraction: 0 }, leader: null };
    expect(select.readyInputs(state({ leader: leader(30), reading }))).toBeNull();
    expect(select.readyInputs(state({ leader: leader(30), settings: null }))).toBeNull();
  });

  it('need no song', () => {
    const one = leader(30);
    expect(select.readyInputs(state({ leader: one }))).toEqual({
      leader: one,
      song: null,
      shift: 0,
      settings,
    });
  });

  it('are up to date exactly while the reaction was generated from the same', () => {
    const one = leader(30);
    const inputs = { leader: one, song: null, shift: 0, settings };
    const reaction = { motion: still(30), latents: null, inputs, label: null, seconds: 1 };
    expect(select.upToDate(state({ leader: one, reaction }))).toBe(true);
    expect(
      select.upToDate(
        state({ leader: one, reaction, settings: { ...settings, guidance: { ...settings.guidance } } }),
      ),
    ).toBe(true);
    expect(select.upToDate(state({ leader: one, reaction, song: song(3) }))).toBe(false);
    for (const changed of [
      { ...settings, seed: 1 },
      { ...settings, music: 0 },
      { ...settings, variety: 0 },
      { ...settings, guidance: uniformGuidance(1.2, 0.65) },
      { ...settings, guidance: { ...settings.guidance, lower: { coarse: 1.2, fine: 0.65 } } },
      { ...settings, role: 'leader' as const },
    ])
      expect(select.upToDate(state({ leader: one, reaction, settings: changed }))).toBe(false);
  });

  it('are up to date where the song of the reaction is gone, wherever it began', () => {
    const one = leader(30);
    const inputs = { leader: one, song: null, shift: 12, settings };
    const reaction = { motion: still(30), latents: null, inputs, label: null, seconds: 1 };
    expect(select.upToDate(state({ leader: one, reaction, shift: 12 }))).toBe(true);
  });
});

describe('guidance matrix', () => {
  it('is streams by layers, row by row', () => {
    const matrix = select.guidanceMatrix(settings, small.latent);
    expect([...matrix].map((value) => Number(value.toFixed(2)))).toEqual([1.2, 0.6, 1.2, 0.6, 1.2, 0.6]);
    const lower = { ...settings, guidance: { ...settings.guidance, lower: { coarse: 2, fine: 3 } } };
    expect([...select.guidanceMatrix(lower, small.latent)].slice(2, 4)).toEqual([2, 3]);
  });
});

describe('notes', () => {
  it('on lengths: the dance is as long as the leader, and silence is mentioned', () => {
    expect(select.lengthNote(state({}))).toBeNull();
    expect(select.lengthNote(state({ leader: leader(300) }))).toContain('No song');
    expect(select.lengthNote(state({ leader: leader(300), song: song(10.2) }))).toBeNull();
    expect(select.lengthNote(state({ leader: leader(300), song: song(6) }))).toContain('silence follows');
    expect(select.lengthNote(state({ leader: leader(300), song: song(60) }))).toContain('not used');
  });

  it('on silent songs, missing beats, file warnings and notices', () => {
    const texts = (more: Partial<AppState>): string[] => select.notes(state(more)).map(({ text }) => text);
    expect(texts({ song: song(5, { silent: true, rhythm: NO_RHYTHM }) })).toEqual([
      'The song is silent: there is no beat to dance to.',
    ]);
    expect(texts({ song: song(5, { rhythm: NO_RHYTHM }) })).toEqual([
      'No steady beat was found in the song.',
    ]);
    const unsure = rhythm([0, 1, 2], { sure: false });
    expect(texts({ song: song(5, { rhythm: unsure }) })).toEqual([
      expect.stringContaining('check the count'),
    ]);
    expect(texts({ leader: leader(30, 'a.bvh', ['The feet slide.']), song: song(1) })).toEqual([
      'The feet slide.',
    ]);
    const moved = leader(30, 'a.bvh', ['The feet slide.'], ['The first frame is left out.']);
    expect(select.notes(state({ leader: moved, song: song(1) }))).toEqual([
      { text: 'The feet slide.', isWarning: true },
      { text: 'The first frame is left out.', isWarning: false },
    ]);
    expect(texts({ notices: ['The storage is full.'] })).toEqual(['The storage is full.']);
  });

  it('on a leader unlike those of training, beside the reaction to it', () => {
    const to = (unfamiliarity: number): string[] => {
      const reaction = {
        motion: still(30),
        latents: null,
        unfamiliarity,
        inputs: { leader: leader(30), song: null, shift: 0, settings },
        label: null,
        seconds: 1,
      };
      return select.notes(state({ leader: leader(30), song: song(1), reaction })).map(({ text }) => text);
    };
    const limit = small.leader.unfamiliar_from;
    expect(to(limit)).toEqual([]);
    expect(to(limit + 0.1)).toEqual([
      expect.stringContaining('unlike the dancers that the model learned from'),
    ]);
  });

  it('one of them where there is no room for more: what may affect the dance comes first', () => {
    const silent = song(3, { silent: true, rhythm: NO_RHYTHM });
    expect(select.firstNote(state({ leader: leader(300), song: silent }))).toEqual({
      text: 'The song is silent: there is no beat to dance to.',
      isWarning: true,
    });
    expect(select.firstNote(state({ leader: leader(300), song: song(60) }))?.text).toContain('not used');
    expect(
      select.firstNote(state({ leader: leader(300), song: song(10.2), notices: ['Elsewhere.'] })),
    ).toBeNull();
  });

  it('on the job', () => {
    const loading = { phase: 'loading', label: 'Model', received: 1e6, total: 2e6 } as const;
    const ready = { phase: 'ready', backend: 'wasm', reason: '' } as const;
    const job = { fraction: 0.3 };
    expect(select.jobText({ ...job, stage: 'waiting' }, { model: loading })).toBe(
      'waiting for the model, 1.0 of 2.0 MB',
    );
    expect(select.jobText({ ...job, stage: 'waiting' }, { model: ready })).toBe('shaping the dance');
    expect(select.jobText({ ...job, stage: 'step' }, { model: ready })).toBe('sampling the dance');
  });
});
