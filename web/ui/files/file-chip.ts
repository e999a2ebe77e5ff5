import { loadedRole, roleName } from '../store/roles';
import { duration, tempo } from '../store/format';
import { jointCount } from './joint-words';
import { el, setText, setVariable, together } from '../widgets/dom';
import { icon } from '../widgets/icons';
import { rateWords } from '../store/selectors';
import type { Services } from '../store/services';
import type { AppState, InputKind } from '../store/state';
import { watchAll, type Store } from '../store/store';

const ASK = { song: 'Choose a song', leader: 'Choose a leader' } as const;

/** The song's or the leader's chip in the bar: its name, what it is, and a click chooses another one. */
export function mountFileChip(
  root: HTMLElement,
  store: Store,
  services: Services,
  side: InputKind,
): () => void {
  const name = el('b');
  const short = el('span');
  const long = el('span', { class: 'long' });
  const foot = el('span', { class: 'foot', attributes: { 'aria-hidden': 'true' } });
  const sign = el('span', { class: 'sign' }, icon(side));
  const chip = el(
    'button',
    {
      class: 'chip',
      attributes: { type: 'button' },
      on: {
        click: () => {
          services.choose(side);
        },
      },
    },
    sign,
    name,
    // Read together, name and facts are words of their own.
    ' ',
    el('span', { class: 'm' }, short, long),
    foot,
  );
  root.append(chip);

  const show = (state: AppState): void => {
    const words = describe(state, side);
    chip.classList.toggle('refused', words.refused);
    chip.classList.toggle('empty', words.name === null);
    setText(name, words.name ?? ASK[side]);
    setText(short, words.short);
    setText(long, words.long);
    foot.hidden = words.fraction === null;
    setVariable(foot, '--part', words.fraction ?? 0);
    chip.title = words.name ?? '';
    const role = loadedRole(state);
    sign.className = `sign ${side === 'song' ? '' : role}`;
    const title = side === 'song' ? 'Song' : roleName(role);
    // Contains the visible text, so that speech control finds the button by it.
    const what = words.name ? `${title}: ${words.name} ${words.short}${words.long}` : `No ${side} yet`;
    chip.setAttribute('aria-label', `${what}. Choose ${words.name ? 'another' : 'one'}`);
  };
  return together(
    watchAll(store, (state) => [state[side], state.reading[side], state.problem, state.settings?.role], show),
    () => {
      chip.remove();
    },
  );
}

interface Words {
  readonly name: string | null;
  readonly short: string;
  readonly long: string;
  readonly refused: boolean;
  readonly fraction: number | null;
}

function describe(state: AppState, side: InputKind): Words {
  const reading = state.reading[side];
  if (reading)
    return { name: reading.name, short: 'reading', long: '', refused: false, fraction: reading.fraction };
  const refused = state.problem?.refused;
  if (refused?.kind === side)
    return { name: refused.name, short: 'not used', long: '', refused: true, fraction: null };
  const plain = { refused: false, fraction: null };
  if (side === 'song' && state.song) {
    const { name, label, data } = state.song;
    const facts = `${duration(data.duration)} · ${tempo(data.tempo)}`;
    return label ? { name, short: label, long: '', ...plain } : { name, short: facts, long: '', ...plain };
  }
  if (side === 'leader' && state.leader) {
    const { name, label, file } = state.leader;
    if (label) return { name, short: label, long: '', ...plain };
    const { clip, report } = file;
    const long = ` · ${jointCount(report)} joints · ${rateWords(report.sourceFps, clip.fps)}`;
    return { name, short: duration(clip.frames / clip.fps), long, ...plain };
  }
  return { name: null, short: '', long: '', ...plain };
}
