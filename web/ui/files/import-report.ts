import { textButton } from '../widgets/button';
import type { Manifest } from '../../model/client';
import type { SolvedMotion } from '../../motion/skeleton/clip';
import { standingHeight } from '../../motion/skeleton/kinematics';
import { loadedRole, roleName } from '../store/roles';
import { el } from '../widgets/dom';
import { countingOf, countedBeats, tempoText } from '../store/counting';
import { centimetres, clockTime, rate } from '../store/format';
import { guidanceText } from '../store/guidance-matrix';
import { jointText } from './joints/joint-text';
import { isVideoName } from './file-type';
import { OFFERED_LEADERS } from './offered';
import { isReading, notes } from '../store/selectors';
import type { Mount, Services } from '../store/services';
import type { LoadedLeader, Reaction, Settings } from '../store/reaction';
import type { AppState } from '../store/state';
import { leaderRefused } from '../store/actions/files';
import { panelToggled } from '../store/actions/view';
import { apply, type Store, watchAll } from '../store/store';

/** Common frame rates of motion capture, for files whose own is wrong. */
export const RATES = [24, 25, 30, 50, 60, 90, 100, 120, 240];

/** The import report: what was read from the files, so that a wrong guess is noticed before a partner is generated. */
export const mountImportReport: Mount = (root, store, services) => {
  const facts = el('dl', { class: 'facts' });
  const list = el('ul', { class: 'notes', attributes: { 'aria-label': 'Notes' } });
  const section = el(
    'section',
    { class: 'sec', attributes: { 'aria-labelledby': 'import-report-head' } },
    el(
      'div',
      { class: 'head' },
      el('h2', { text: 'Import report', attributes: { id: 'import-report-head' } }),
    ),
    facts,
    list,
  );
  root.append(section);

  const show = (state: AppState): void => {
    const focused = document.activeElement?.id;
    facts.replaceChildren(
      ...songFacts(state),
      ...leaderFacts(state, store, services),
      ...(state.reaction ? reactionFacts(state.reaction) : []),
      ...(state.manifest ? modelFacts(state.manifest, backendReason(state)) : []),
    );
    list.replaceChildren(
      ...notes(state).map(({ text, isWarning }) => el('li', { text, class: isWarning ? 'warning' : '' })),
    );
    if (focused) document.getElementById(focused)?.focus();
  };
  watchAll(store, reported, show);
};

/** What the report is made of: it is made anew when one of these changes, which closes a list that is open in it. */
export function reported(state: AppState): readonly unknown[] {
  return [
    state.song,
    state.shift,
    state.countings,
    state.leader,
    state.refusedLeader,
    ...isReading(state),
    state.reaction,
    state.manifest,
    backendReason(state),
    state.notices,
    state.autosave,
    state.settings?.role,
  ];
}

/** Where the model computes, and why; null until it is ready. */
function backendReason({ model }: AppState): string | null {
  return model.phase === 'ready' ? model.reason : null;
}

function group(className: string, name: string): HTMLElement {
  return el('dt', { class: `group ${className}` }, el('span', { class: 'dot' }), name);
}

function fact(name: string, value: string | HTMLElement): HTMLElement[] {
  return [el('dt', { text: name }), el('dd', {}, value)];
}

function songFacts(state: AppState): HTMLElement[] {
  const { song, reading, countings } = state;
  if (!song) return [group('', 'Song'), ...fact('File', reading.song ? 'being read' : 'none yet, silence')];
  const beats = countedBeats(state).times.length;
  const { beatsPerBar } = countingOf(song, countings);
  return [
    group('', 'Song'),
    ...fact('Length', clockTime(song.data.duration)),
    ...fact('Tempo', tempoText(song, countings)),
    ...(beats > 0 ? fact('Beats', `${beats}, in bars of ${beatsPerBar}`) : []),
  ];
}

function leaderFacts(state: AppState, store: Store, services: Services): HTMLElement[] {
  const { leader, reading } = state;
  const role = loadedRole(state);
  const head = group(role, roleName(role));
  if (!leader) {
    const file = fact('File', reading.leader ? 'being read' : 'none yet');
    const change = state.refusedLeader ? fact('Change', importButton(store)) : [];
    return [head, ...file, ...change, ...fact('Other', offeredSelect(services))];
  }
  const { clip, report } = leader.file;
  const length = fact('Length', `${clockTime(clip.frames / clip.fps)}, ${clip.frames} frames`);
  if (isVideoName(leader.name))
    return [
      head,
      ...length,
      ...fact('Format', `video; its dancer was found in the pictures, ${clip.fps} times a second`),
      ...fact('Other', offeredSelect(services)),
    ];
  return [
    head,
    ...length,
    ...fact('Frame rate', rateSelect(leader, services)),
    ...fact('Format', [report.format, partText(report)].filter(Boolean).join(', ')),
    ...fact('Skeleton', `${report.convention}, ${Math.round(100 * report.confidence)} % certain`),
    ...fact('Joints', jointText(report)),
    ...fact('Units', `${report.unit}, ${report.upAxis} up`),
    ...fact('Change', importButton(store)),
    ...fact('Other', offeredSelect(services)),
  ];
}

/** Takes one of the leaders that ship with the page. */
function offeredSelect(services: Services): HTMLSelectElement {
  const select = el(
    'select',
    {
      attributes: { id: 'offered-leaders', 'aria-label': 'Take one of our leaders' },
      on: {
        change: () => {
          services.openOffered(select.value);
          select.value = '';
        },
      },
    },
    el('option', { text: 'one of ours', attributes: { value: '' } }),
    ...OFFERED_LEADERS.map(({ file, name }) => el('option', { text: name, attributes: { value: file } })),
  );
  return select;
}

/** Opens the panel in which joints, unit, axes and clip are set by hand: of the loaded leader, where there is one. */
function importButton(store: Store): HTMLElement {
  return textButton(
    'btn ghost',
    'Joints and units',
    () => {
      if (store.getState().leader) apply(store, leaderRefused(null));
      apply(store, panelToggled('import'));
    },
    { id: 'open-import' },
  );
}

/** Which of a file's clips or dancers was read; null where there is one. */
export function partText({ parts, part }: LoadedLeader['file']['report']): string | null {
  return parts.length > 1 ? `${parts[part] ?? ''} (${part + 1} of ${parts.length})` : null;
}

/** The file's frame rate; choosing another one reads the file again. */
function rateSelect(leader: LoadedLeader, services: Services): HTMLElement {
  const { clip, report } = leader.file;
  const own = leader.options.fps;
  const rates = own === undefined || RATES.includes(own) ? RATES : [...RATES, own].sort((a, b) => a - b);
  const select = el(
    'select',
    {
      attributes: { id: 'leader-rate', 'aria-label': 'Frame rate of the leader file' },
      on: {
        change: () => {
          const fps = select.value === '' ? undefined : Number(select.value);
          services.rereadLeader(leader, { ...leader.options, fps });
        },
      },
    },
    el('option', {
      text: own === undefined ? `${rate(report.sourceFps)} fps, as in the file` : 'As in the file',
      attributes: { value: '' },
    }),
    ...rates.map((fps) => el('option', { text: `${rate(fps)} fps`, attributes: { value: fps } })),
  );
  select.value = String(own ?? '');
  const rest = Math.abs(report.sourceFps - clip.fps) > 0.01 ? ` to ${rate(clip.fps)} fps` : '';
  return el('span', {}, select, rest);
}

function reactionFacts({ motion, inputs, label, seconds }: Reaction): HTMLElement[] {
  const { seed, role, holdHands } = inputs.settings;
  return [
    group(role, roleName(role)),
    ...fact('From', `seed ${seed}`),
    ...fact('Guidance', guidanceText(inputs.settings)),
    ...fact('Height', heightText(motion, inputs.settings)),
    ...fact('Hands', holdHands ? 'held where they are near' : 'as generated'),
    ...fact('Made', label ?? (seconds === null ? 'ready-made' : `here, in ${seconds.toFixed(1)} s`)),
    ...(label === null
      ? fact('Bones', `constant length, ${millimetres(motion.fitError)} off the model’s joints`)
      : []),
  ];
}

/** `148 cm, in proportion`. */
function heightText({ offsets }: SolvedMotion, { height }: Settings): string {
  return `${centimetres(standingHeight(offsets))} cm, ${height === null ? 'in proportion' : 'as set'}`;
}

function millimetres(metres: number): string {
  return `${(metres * 1000).toFixed(1)} mm`;
}

function modelFacts(manifest: Manifest, reason: string | null): HTMLElement[] {
  return [
    group('', 'Model'),
    ...fact('Name', manifest.name),
    ...(reason === null ? [] : fact('Runs on', reason)),
    ...aboutModel(manifest).flatMap(([name, text]) => fact(name, text)),
    ...fact('Software', licencesLink()),
  ];
}

/** What the card of a model says of its rights, its origin and its limits: names and texts. */
export function aboutModel({ licence, attribution, notes }: Manifest): [name: string, text: string][] {
  return [
    ['Licence', licence.weights],
    ['Data', licence.data],
    ['From', attribution],
    ...notes.map((note): [string, string] => ['Note', note]),
  ];
}

/** Licence texts of all software in the page, in a file that the build writes. */
function licencesLink(): HTMLElement {
  return el('a', {
    text: 'Licences',
    attributes: { id: 'licences', href: 'licences.txt', target: '_blank' },
  });
}
