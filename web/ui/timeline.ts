import { peaks, speedCurve, type Peaks } from './curves';
import { el, setText, setVariable, together } from './dom';
import { clockTime } from './format';
import { drawBeats, drawCurve, drawWave, surface, token } from './lane-canvas';
import { mountPlayhead } from './playhead';
import { reactorMotion } from './reactor-motion';
import { rulerMarks } from './ruler';
import { beingRead, danceDuration, jobWords, upToDate } from './selectors';
import type { Mount } from './services';
import type { AppState } from './state';
import { watch, watchAll } from './store';

/** Speed that a lane's upper edge stands for at least, m/s, so that standing still looks still. */
const LEAST_TOP = 1;
/** Room above the fastest usual moment. */
const HEADROOM = 1.2;

/** The score: ruler, song, leader and reactor over the same seconds, and the playhead across them. */
export const mountTimeline: Mount = (root, store, services) => {
  const ruler = el('div', { class: 'lane ruler', attributes: { 'aria-hidden': 'true' } });
  const rulerName = el('div', { class: 'lab ruler' });
  const wave = el('canvas');
  const wavePast = el('canvas');
  const past = el('div', { class: 'past' }, wavePast);
  const noSong = el('div', { class: 'none' });
  const songLane = el('div', { class: 'lane song', attributes: { role: 'img' } }, wave, past, noSong);
  const leaderCurve = el('canvas');
  const leaderWord = el('span', { class: 'word' });
  const leaderLane = el(
    'div',
    { class: 'lane mot lead-lane', attributes: { role: 'img' } },
    el('div', { class: 'base' }),
    leaderCurve,
    leaderWord,
  );
  const blocks = el('div');
  const reactorCurve = el('canvas');
  const reactorWord = el('span', { class: 'word' });
  const reactorLane = el(
    'div',
    { class: 'lane mot', attributes: { role: 'img' } },
    blocks,
    reactorCurve,
    reactorWord,
  );
  const lanes = el(
    'div',
    { class: 'lanes' },
    rulerName,
    ruler,
    el('div', { class: 'lab song', text: 'Song' }),
    songLane,
    el('div', { class: 'lab mot lead-lane lead' }, el('span', { class: 'dot' }), 'Leader'),
    leaderLane,
    el('div', { class: 'lab mot reac' }, el('span', { class: 'dot' }), 'Reactor'),
    reactorLane,
  );
  root.append(lanes);
  const playhead = mountPlayhead(lanes, store, services);

  const drawSong = (state: AppState): void => {
    const seconds = danceDuration(state);
    const { song } = state;
    noSong.hidden = song !== null || seconds === 0;
    setText(noSong, state.reading.song ? 'Reading the song' : 'No song: silence');
    songLane.setAttribute(
      'aria-label',
      song ? `Waveform of ${song.name}, ${song.data.beats.length} beats` : 'No song',
    );
    const surfaces = [surface(wave), surface(wavePast)] as const;
    if (!song || seconds === 0) return;
    const columns = Math.max(1, Math.round(wave.clientWidth * Math.min(2, window.devicePixelRatio)));
    const shape: Peaks = peaks(song.data.pcm, song.data.sampleRate, seconds, columns);
    surfaces.forEach((each, index) => {
      if (!each) return;
      const colours = {
        bar: token(root, '--text-2'),
        beat: token(root, '--control-line'),
        line: token(root, '--line'),
      };
      drawBeats(each, song.data.beats, seconds, colours);
      drawWave(each, shape, token(root, index === 0 ? '--wave' : '--wave-past'));
    });
  };

  let leaderSpeed: Float32Array = new Float32Array(0);
  let reactorSpeed: Float32Array = new Float32Array(0);
  const drawMotion = (state: AppState): void => {
    const top = Math.max(LEAST_TOP, HEADROOM * usualMost([...leaderSpeed, ...reactorSpeed]));
    const pairs = [
      [leaderCurve, leaderSpeed, 'leader'],
      [reactorCurve, reactorSpeed, 'reactor'],
    ] as const;
    for (const [canvas, curve, who] of pairs) {
      const on = surface(canvas);
      const colours = { line: token(root, `--${who}`), fill: token(root, `--${who}-soft`) };
      if (on && curve.length > 0) drawCurve(on, curve, top, colours);
    }
    leaderLane.setAttribute('aria-label', state.leader ? speedWords('Leader', leaderSpeed) : 'No leader');
    reactorLane.setAttribute(
      'aria-label',
      state.reaction ? speedWords('Reactor', reactorSpeed) : 'No reactor yet',
    );
    setText(leaderWord, state.leader ? '' : state.reading.leader ? 'Reading the leader' : 'No leader yet');
  };

  const drawRuler = (state: AppState): void => {
    const { name, marks } = rulerMarks(state.song?.data.beats ?? [], danceDuration(state), ruler.clientWidth);
    setText(rulerName, name);
    ruler.replaceChildren(
      ...marks.map(({ text, at }) => {
        const mark = el('span', { text });
        setVariable(mark, '--at', at);
        return mark;
      }),
    );
  };

  const drawBlocks = (state: AppState): void => {
    const seconds = danceDuration(state);
    const { manifest } = state;
    const length = manifest ? (manifest.latent.block * manifest.latent.stride) / manifest.fps : seconds;
    const count = seconds > 0 && length > 0 ? Math.ceil(seconds / length - 1e-6) : 1;
    blocks.replaceChildren(
      ...Array.from({ length: count }, (_, index) => {
        const block = el('div', { class: 'blk' }, el('div', { class: 'p' }));
        const from = seconds > 0 ? (index * length) / seconds : 0;
        setVariable(block, '--from', from);
        setVariable(block, '--span', seconds > 0 ? Math.min(1, from + length / seconds) - from : 1);
        return block;
      }),
    );
  };

  const redraw = (): void => {
    const state = store.getState();
    drawRuler(state);
    drawSong(state);
    drawMotion(state);
  };
  const sizes = new ResizeObserver(redraw);
  sizes.observe(lanes);

  return together(
    watch(
      store,
      (state) => state.leader?.motion,
      (motion) => {
        leaderSpeed = motion ? speedCurve(motion) : new Float32Array(0);
      },
    ),
    watch(store, reactorMotion, (motion) => {
      reactorSpeed = motion ? speedCurve(motion) : new Float32Array(0);
    }),
    watchAll(store, (state) => [state.leader, state.song, state.manifest], drawBlocks),
    watchAll(
      store,
      (state) => [state.leader, state.song, reactorMotion(state), ...beingRead(state), state.theme],
      redraw,
    ),
    watchAll(
      store,
      (state) => [state.job, state.reaction, state.leader],
      (state) => {
        const { job } = state;
        blocks.style.setProperty('--part', String(job ? job.fraction : 0));
        reactorLane.classList.toggle('stale', job !== null && !upToDate(state));
        const waiting = state.leader && !state.reaction;
        setText(reactorWord, waiting ? (job ? capital(jobWords(job, state)) : 'Not made yet') : '');
      },
    ),
    watchAll(
      store,
      (state) => [state.playback.time, state.leader, state.song],
      (state) => {
        const whole = danceDuration(state);
        const part = whole > 0 ? state.playback.time / whole : 0;
        past.style.clipPath = `inset(0 ${(100 - part * 100).toFixed(3)}% 0 0)`;
      },
    ),
    playhead,
    () => {
      sizes.disconnect();
      lanes.remove();
    },
  );
};

/** The speed that only one moment in fifty exceeds: a single hasty turn must not flatten all the rest. */
function usualMost(speeds: number[]): number {
  return speeds.sort((a, b) => a - b)[Math.floor(speeds.length * 0.98)] ?? 0;
}

function speedWords(who: string, curve: Float32Array): string {
  let sum = 0;
  let most = 0;
  let at = 0;
  curve.forEach((speed, index) => {
    sum += speed;
    if (speed > most) [most, at] = [speed, index];
  });
  const mean = (sum / Math.max(1, curve.length)).toFixed(2);
  return `${who} speed, ${mean} metres per second on average, fastest at ${clockTime(at / 30)}`;
}

function capital(text: string): string {
  return text.charAt(0).toUpperCase() + text.slice(1);
}
