import type { Reference } from '../store/state';
import * as v from 'valibot';

const known = v.nullable(v.number());

/** The part of metrics.json, the report that lies beside a shipped model, that says how the recorded dancers do. */
const schema = v.object({
  model: v.string(),
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

/** Reads it; null where there is none, as beside a model of one's own. */
export async function readReference(manifestUrl: string): Promise<Reference | null> {
  try {
    const response = await fetch(new URL('metrics.json', manifestUrl));
    if (!response.ok) return null;
    const { model, rows } = v.parse(schema, await response.json());
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
