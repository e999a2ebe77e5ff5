import { partText } from './import-report';
import { loadedRole, roleName } from '../store/roles';
import { tempoText } from '../store/counting';
import { duration } from '../store/format';
import { el, setText, setVariable } from '../widgets/dom';
import { icon } from '../widgets/icons';
import { rateText } from '../store/selectors';
import type { Services } from '../store/services';
import type { AppState, InputKind } from '../store/state';
import { watchAll, type Store } from '../store/store';

const ASK = { song: 'Choose a song', leader: 'Choose a leader' } as const;

/** Which files can be chosen. */
const KINDS = { song: 'mp3, wav, ogg, flac, m4a', leader: 'a video or a motion file' } as const;

/** The song's or the leader's chip in the bar: its name, below it what it is, and a click chooses another one. */
export function mountFileChip(root: HTMLElement, store: Store, services: Services, side: InputKind): void {
  const name = el('b');
  const details = el('small');
  const progress = el('span', { class: 'reading-progress', attributes: { 'aria-hidden': 'true' } });
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
    // A space, so that screen readers do not join name and details.
    el('span', { class: 'lines' }, name, ' ', details),
    progress,
  );
  root.append(chip);

  const show = (state: AppState): void => {
    const content = describe(state, side);
    chip.classList.toggle('refused', content.refused);
    chip.classList.toggle('empty', content.name === null);
    setText(name, content.name ?? ASK[side]);
    name.translate = content.name === null;
    setText(details, content.details);
    progress.hidden = content.fraction === null;
    setVariable(progress, '--part', content.fraction ?? 0);
    chip.title = content.name ? `${content.name}, ${content.details}. Click to choose another` : '';
    const role = loadedRole(state);
    sign.className = `sign ${side === 'song' ? '' : role}`;
    const title = side === 'song' ? 'Song' : roleName(role);
    // Contains the visible text, so that speech control finds the button by it.
    const what = content.name ? `${title}: ${content.name} ${content.details}` : `No ${side} yet`;
    chip.setAttribute('aria-label', `${what}. Choose ${content.name ? 'another' : 'one'}`);
  };
  watchAll(
    store,
    (state) => [state[side], state.reading[side], state.countings, state.problem, state.settings?.role],
    show,
  );
}

interface ChipContent {
  readonly name: string | null;
  readonly details: string;
  readonly refused: boolean;
  readonly fraction: number | null;
}

function describe(state: AppState, side: InputKind): ChipContent {
  const reading = state.reading[side];
  if (reading) return { name: reading.name, details: 'reading', refused: false, fraction: reading.fraction };
  const refused = state.problem?.refused;
  if (refused?.kind === side)
    return { name: refused.name, details: 'not used', refused: true, fraction: null };
  const plain = { refused: false, fraction: null };
  if (side === 'song' && state.song) {
    const { name, label, data } = state.song;
    const tempo = tempoText(state.song, state.countings);
    return { name, details: joined(duration(data.duration), tempo, label), ...plain };
  }
  if (side === 'leader' && state.leader) {
    const { name, label, file } = state.leader;
    const { clip, report } = file;
    const facts = [
      duration(clip.frames / clip.fps),
      rateText(report.sourceFps, clip.fps),
      // Another one is chosen in the import report.
      partText(report),
    ];
    return { name, details: joined(...facts, label), ...plain };
  }
  return { name: null, details: KINDS[side], ...plain };
}

function joined(...facts: readonly (string | null)[]): string {
  return facts.filter((fact) => fact !== null).join(' · ');
}
