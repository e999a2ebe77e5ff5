import type { Manifest } from '../../model/client';
import type { Control } from '../widgets/fader';
import { clampedToStep, rangeOf, sameGuidance, uniform } from '../store/guidance-matrix';
import type { Weights } from '../store/reaction';

type Range = Manifest['guidance']['coarse'];

/** Weights under a name. */
export interface Preset extends Weights {
  readonly name: string;
  /** What to expect of it, in a sentence. */
  readonly description: string;
}

/** Presets by what they do: share of the way from the default to an end of the range, below 0 to the lower end. */
const KINDS: readonly {
  readonly name: string;
  readonly description: string;
  readonly towards: Readonly<Partial<Record<Control, number>>>;
}[] = [
  { name: 'Balanced', description: 'The default of this model.', towards: {} },
  { name: 'Loose', description: 'Smaller moves, less tied to the leader.', towards: { coarse: -0.7 } },
  { name: 'Large', description: 'Larger moves, more on the leader’s beats.', towards: { coarse: 0.6 } },
  { name: 'Soft', description: 'Less quick movement, few accents.', towards: { fine: -0.8 } },
  { name: 'Sharp', description: 'More quick movement, strong accents.', towards: { fine: 0.8 } },
  { name: 'More song', description: 'The song changes the dance most.', towards: { music: 1 } },
  { name: 'Less song', description: 'The song hardly changes the dance.', towards: { music: -1 } },
  { name: 'Average', description: 'The average of several seeds.', towards: { variety: -1 } },
  { name: 'Individual', description: 'Unlike the other seeds.', towards: { variety: 0.7 } },
  {
    name: 'Calm',
    description: 'Near the average and soft.',
    towards: { fine: -0.6, variety: -0.6 },
  },
  {
    name: 'Lively',
    description: 'Large, sharp and unlike other seeds.',
    towards: { coarse: 0.4, fine: 0.6, variety: 0.5 },
  },
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
    variety: at(guidance.variety, towards.variety),
  }));
}

/** The preset whose values these are, if any. */
export function presetOf(list: readonly Preset[], { guidance, music, variety }: Weights): Preset | null {
  return (
    list.find(
      (preset) =>
        preset.music === music && preset.variety === variety && sameGuidance(preset.guidance, guidance),
    ) ?? null
  );
}
