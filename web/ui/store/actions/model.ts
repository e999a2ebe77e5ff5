/** The model. */
import type { Manifest } from '../../../model/client';
import { defaultGuidance } from '../guidance-matrix';
import { generatedRole } from '../roles';
import type { ModelState } from '../state';
import type { Change } from '../store';
import { NO_HISTORY } from '../history/history';
import { takesForOtherModel } from '../take';

/** A manifest gives all settings but a locked seed their defaults, also where a model was there before. */
export function manifestLoaded(manifest: Manifest, seed: number): Change {
  return ({ settings, seedLocked }) => ({
    manifest,
    settings: {
      guidance: defaultGuidance(manifest),
      music: manifest.guidance.music.default,
      variety: manifest.guidance.variety.default,
      seed: settings && seedLocked ? settings.seed : seed,
      role: 'reactor',
      height: null,
      holdHands: true,
    },
  });
}

/** Another model replaces the present one, with its defaults, and without the song if its audio recipe differs. */
export function modelOpened(manifest: Manifest, seed: number): Change {
  return (state) => {
    const before = state.manifest;
    const fresh = manifestLoaded(manifest, seed)(state);
    const sameRecipe = before !== null && JSON.stringify(before.audio) === JSON.stringify(manifest.audio);
    const lost =
      state.song && !sameRecipe ? ` It analyses songs differently: drop ${state.song.name} again.` : '';
    return {
      ...fresh,
      // The dance on the stage stays, and with it who leads.
      settings: { ...fresh.settings!, role: generatedRole(state) },
      ...(!sameRecipe && { song: null, shift: 0 }),
      ...takesForOtherModel(state, sameRecipe),
      variations: null,
      // Undo would bring back settings of the other model.
      history: NO_HISTORY,
      notices: [...state.notices, `Your model “${manifest.name}” now makes the partner.${lost}`],
    };
  };
}

export function modelChanged(model: ModelState): Change {
  return () => ({ model });
}
