import type { Reference } from '../store/state';
import * as v from 'valibot';

const known = v.nullable(v.number());

/** The part of metrics.json, the evaluation of a shipped model, with the scores of the recorded dancers. */
const schema = v.object({
  rows: v.object({
    truth: v.object({
      mean: v.object({
        skate_share: known,
        contact_share: known,
        slide_speed: known,
        ipr_capsules: known,
        bas: known,
        bed_forward: known,
      }),
    }),
  }),
});

/**
 * Reads the scores of the recorded dancers; null where there are none, as beside a visitor's own model.
 * @param model id of the model of that manifest
 */
export async function readReference(manifestUrl: string, model: string): Promise<Reference | null> {
  try {
    const response = await fetch(new URL('metrics.json', manifestUrl));
    if (!response.ok) return null;
    const { rows } = v.parse(schema, await response.json());
    const { mean } = rows.truth;
    return {
      model,
      skateShare: mean.skate_share,
      contactShare: mean.contact_share,
      slideSpeed: mean.slide_speed,
      overlapShare: mean.ipr_capsules,
      music: mean.bas,
      leader: mean.bed_forward,
    };
  } catch {
    return null;
  }
}
