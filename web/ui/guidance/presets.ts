import type { Manifest } from '../../model/client';
import { defaultGuidance, sameGuidance, uniform } from '../store/guidance-matrix';
import type { Guidance, Settings } from '../store/reaction';

/** Named guidance weights. */
export interface Preset {
  readonly name: string;
  /** What to expect of it, in a sentence. */
  readonly description: string;
  readonly group: 'This model' | 'From the paper, Table 4';
  readonly guidance: Guidance;
  readonly music: number;
}

/**
 * Rows of the paper's Table 4, S = [coarse, fine], with what they did best there. The exported graphs follow the
 * paper's Eq. 9, so the numbers mean the same here; the descriptions are of the paper's model and dances.
 */
const TABLE_4: readonly (readonly [coarse: number, fine: number, name: string, description: string])[] = [
  [1, 1, 'Lightest', 'The least guidance that the paper tried.'],
  [1, 1.2, 'Finer detail', 'More of the detail, a light hand on the shape.'],
  [1, 1.5, 'Closest couple', 'The couple moved most like real couples.'],
  [1.2, 1.2, "Paper's choice", 'What the paper chose: a balance of both.'],
  [1.2, 1.5, 'Truest poses', 'Poses and speeds were nearest to the recorded ones.'],
  [1.5, 1.5, 'Most varied', 'The most varied motion, the loosest couple.'],
];

/** The presets for a model: its own default and the paper's. */
export function presets(manifest: Pick<Manifest, 'latent' | 'guidance'>): Preset[] {
  const { streams, layers } = manifest.latent;
  const own: Preset = {
    name: 'Balanced',
    description: 'What suits this model best.',
    group: 'This model',
    guidance: defaultGuidance(manifest),
    music: manifest.guidance.music.default,
  };
  const paper = TABLE_4.map(([coarse, fine, name, description]): Preset => ({
    name,
    description,
    group: 'From the paper, Table 4',
    guidance: uniform(streams, layers, (layer) => (layer === 'coarse' ? coarse : fine)),
    // Eq. 9 has no separate guidance by the music.
    music: 0,
  }));
  return [own, ...paper];
}

/** The preset whose values these are, if any. */
export function presetOf(
  list: readonly Preset[],
  { guidance, music }: Pick<Settings, 'guidance' | 'music'>,
): Preset | null {
  return list.find((preset) => preset.music === music && sameGuidance(preset.guidance, guidance)) ?? null;
}
