import { el } from '../widgets/dom';
import { icon } from '../widgets/icons';

const ID = 'how-it-works';

/** The three steps. */
function steps(): HTMLElement {
  return el(
    'ol',
    { class: 'steps' },
    el('li', {
      text: 'Choose a leader, which is a video of one dancer or a motion file, and a song.',
    }),
    el('li', {
      text: 'Your browser makes the partner. The sliders change how it dances.',
    }),
    el('li', { text: 'Play it, then download the motion for Blender, Maya and other tools.' }),
  );
}

/** A button that opens the explanation. */
export function opensHowItWorks(): HTMLButtonElement {
  return el('button', {
    class: 'link',
    text: 'How it works',
    attributes: { type: 'button', popovertarget: ID, 'aria-haspopup': 'dialog' },
  });
}

/** The whole explanation: how to use the page, what files it takes, and where a leader comes from. */
export function howItWorks(): HTMLElement {
  return el(
    'div',
    {
      class: 'float explain',
      attributes: { id: ID, popover: 'auto', role: 'dialog', 'aria-label': 'How it works' },
    },
    el(
      'div',
      { class: 'head' },
      el('h2', { text: 'How it works' }),
      el(
        'button',
        {
          class: 'icon',
          attributes: {
            type: 'button',
            'aria-label': 'Close',
            popovertarget: ID,
            popovertargetaction: 'hide',
          },
        },
        icon('close'),
      ),
    ),
    steps(),
    el('h3', { text: 'What it takes' }),
    el(
      'ul',
      {},
      item('Song', 'mp3, wav, ogg, flac, m4a or opus. Without one the couple dances in silence.'),
      item(
        'Leader',
        'a video of one dancer, or a motion file: BVH, FBX, glTF, VRMA, VMD, AMC with ASF, C3D, NPZ, NPY, JSON, CSV or TRC, also in a zip archive. The dance is as long as the leader.',
      ),
    ),
    el('h3', { text: 'Where a leader comes from' }),
    el(
      'ul',
      {},
      item(
        'A phone',
        'film one dancer, whole in the picture; the phone may turn with them, but stays in its place.',
      ),
      item('Blender', 'select the armature, then File, Export, Motion Capture (.bvh).'),
      item('Mixamo', 'download a dance as FBX.'),
      item('Motion capture', 'suits, and apps that watch a video, can save BVH: Rokoko and DeepMotion do.'),
      item('This page', 'a dance downloaded here can be the leader of the next one.'),
    ),
  );
}

function item(name: string, words: string): HTMLElement {
  return el('li', {}, el('b', { text: `${name}: ` }), words);
}
