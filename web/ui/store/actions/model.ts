/** What happens to the model that dances. */
import type { Manifest } from '../../../model/client';
import { defaultGuidance } from '../guidance-matrix';
import type { ModelState } from '../state';
import type { Change } from '../store';
import { NO_HISTORY } from '../history';
import { takesForOtherModel } from '../take';

/** The manifest brings the settings' defaults; settings made before it (a second model) start over. */
export function manifestLoaded(manifest: Manifest, seed: number): Change {
  return () => ({
    manifest,
    settings: {
      guidance: defaultGuidance(manifest),
      music: manifest.guidance.music.default,
      steps: manifest.diffusion.steps.default,
      seed,
      role: 'reactor',
    },
  });
}

/** Another model takes over: its own defaults, and no song that was heard in a way it does not know. */
export function modelOpened(manifest: Manifest, seed: number): Change {
  return (state) => {
    const before = state.manifest;
    const hearsAlike = before !== null && JSON.stringify(before.audio) === JSON.stringify(manifest.audio);
    const lost =
      state.song && !hearsAlike ? ` It hears songs in another way: drop ${state.song.name} again.` : '';
    return {
      ...manifestLoaded(manifest, seed)(state),
      ...(!hearsAlike && { song: null, shift: 0 }),
      ...takesForOtherModel(state, hearsAlike),
      // What another model was asked for can't be asked of this one.
      history: NO_HISTORY,
      notices: [...state.notices, `The partner is danced by your model “${manifest.name}”.${lost}`],
    };
  };
}

export function modelChanged(model: ModelState): Change {
  return () => ({ model });
}
