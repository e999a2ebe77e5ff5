import type { Manifest } from '../../model/client';
import { clampedToStep, rangeOf, sameGuidance, uniform } from '../store/guidance-matrix';
import type { Guidance, Settings } from '../store/reaction';

type Range = Manifest['guidance']['coarse'];

/** Named guidance weights. */
export interface Preset {
  readonly name: string;
  /** What to expect of it, in a sentence. */
  readonly description: string;
  readonly guidance: Guidance;
  readonly music: number;
}

/** Presets by what they do: share of the way from the default to an end of the range, below 0 to the lower end. */
const KINDS: readonly {
  readonly name: string;
  readonly description: string;
  readonly towards: Readonly<Partial<Record<'coarse' | 'fine' | 'music', number>>>;
}[] = [
  { name: 'Balanced', description: 'What suits this model best.', towards: {} },
  { name: 'Loose', description: 'Smaller moves, a path more of its own.', towards: { coarse: -0.7 } },
  { name: 'Large', description: 'Larger moves, farther around the leader.', towards: { coarse: 0.6 } },
  { name: 'Soft', description: 'Without accents.', towards: { fine: -0.8 } },
  { name: 'Sharp', description: 'Strong accents.', towards: { fine: 0.8 } },
  { name: 'Song first', description: 'The song shapes the dance most.', towards: { music: 1 } },
  { name: 'Leader only', description: 'The song is not listened to.', towards: { music: -1 } },
];

/** The presets for a model's ranges. */
export function presets({ latent, guidance }: Pick<Manifest, 'latent' | 'guidance'>): Preset[] {
  const at = (range: Range, share = 0): number =>
    clampedToStep(
      range.default + (share < 0 ? range.default - range.min : range.max - range.default) * share,
      range,
    );
  return KINDS.map(({ name, description, towards }) => ({
    name,
    description,
    guidance: uniform(latent.streams, latent.layers, (layer) =>
      at(rangeOf(guidance, layer), layer === 'coarse' ? towards.coarse : towards.fine),
    ),
    music: at(guidance.music, towards.music),
  }));
}

/** The preset whose values these are, if any. */
export function presetOf(
  list: readonly Preset[],
  { guidance, music }: Pick<Settings, 'guidance' | 'music'>,
): Preset | null {
  return list.find((preset) => preset.music === music && sameGuidance(preset.guidance, guidance)) ?? null;
}
