import { textButton } from '../widgets/button';
import { OFFERED_LEADERS } from '../files/offered';
import { duration } from '../store/format';
import { el, setHidden, setText } from '../widgets/dom';
import { howItWorks, opensHowItWorks } from './how-it-works';
import { icon } from '../widgets/icons';
import { danceDuration } from '../store/selectors';
import type { Mount, Services } from '../store/services';
import type { AppState, InputKind } from '../store/state';
import { watchAll } from '../store/store';

/** The block of the first visit: what the page does, a button for the demo, and buttons for one's own files. */
export const mountFirstVisit: Mount = (root, store, services) => {
  const play = el(
    'button',
    {
      class: 'btn primary',
      attributes: { type: 'button' },
      on: { click: services.playDemo },
    },
    icon('play'),
    'Play the demo',
  );
  const about = el('small');
  const offered = offeredLeaders(services);
  const block = el(
    'section',
    { class: 'first-visit', attributes: { 'aria-label': 'Start' } },
    el('h1', { text: 'Drop a video of a dancer. Watch the partner answer.' }),
    el('p', {
      class: 'intro',
      text: 'A motion file will do as well. Your browser makes the dance partner and shows both in 3D.',
    }),
    el('div', { class: 'go' }, play, about),
    el(
      'div',
      { class: 'drop', attributes: { role: 'group', 'aria-label': 'Your files' } },
      fileChoice(
        services,
        'leader',
        'Leader',
        'a video of one dancer, or a motion file',
        cameraButton(services),
      ),
      fileChoice(services, 'song', 'Song', 'mp3, wav, flac and others'),
    ),
    offered,
    el(
      'p',
      { class: 'how' },
      icon('shield'),
      el(
        'span',
        {},
        el('span', { class: 'desk', text: 'Drop both anywhere. ' }),
        'Your files never leave this browser. ',
        opensHowItWorks(),
      ),
    ),
    howItWorks(),
  );
  root.append(block);

  const show = (state: AppState): void => {
    setHidden(block, !state.firstVisit, document.querySelector('.play'));
    root.classList.toggle('visiting', state.firstVisit);
    play.hidden = state.demo === 'missing';
    play.disabled = state.demo !== 'ready';
    // They dance to the demo's song, which a leader that comes before it would keep away.
    for (const button of offered.querySelectorAll('button')) button.disabled = state.demo === 'loading';
    setText(about, demoText(state));
  };
  watchAll(store, (state) => [state.firstVisit, state.demo, state.reaction, state.leader, state.song], show);
};

function demoText(state: AppState): string {
  if (state.demo === 'loading') return 'Loading the demo';
  if (state.demo === 'missing') return 'The demo could not be loaded. Your own files work.';
  const length = duration(danceDuration(state));
  return state.reaction ? `${length} duet, ready to play` : `${length}, the partner is being made`;
}

function cameraButton(services: Services): HTMLElement {
  return textButton('btn ghost camera', 'Use the camera', services.recordVideo);
}

/** Buttons for the leaders that need no file. */
function offeredLeaders(services: Services): HTMLElement {
  return el(
    'div',
    { class: 'offered', attributes: { role: 'group', 'aria-label': 'Leaders that need no file' } },
    el('span', { text: 'No file at hand? Take one of ours:' }),
    ...OFFERED_LEADERS.map(({ file, name }) =>
      textButton('btn', name, () => {
        services.openOffered(file);
      }),
    ),
  );
}

function fileChoice(
  services: Services,
  side: InputKind,
  name: string,
  kinds: string,
  more: HTMLElement | null = null,
): HTMLElement {
  // A small screen has no room for the word Leader above it.
  const what =
    side === 'song'
      ? ['song']
      : [el('span', { class: 'titled', text: 'file' }), el('span', { class: 'untitled', text: 'dancer' })];
  return el(
    'div',
    {},
    el('b', {}, el('span', { class: side === 'leader' ? 'sign leader' : 'sign' }, icon(side)), name),
    el('p', { text: kinds }),
    el(
      'div',
      { class: 'choices' },
      el(
        'button',
        {
          class: 'btn tint',
          attributes: { type: 'button' },
          on: {
            click: () => {
              services.choose(side);
            },
          },
        },
        el('span', { text: 'Choose a ' }, ...what),
      ),
      more,
    ),
  );
}
