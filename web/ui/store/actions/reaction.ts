/** What happens to the reaction and to what is known of it. */
import type { FrameRange, Job, Preview, Quality, Reaction, Reference } from '../state';
import type { Change } from '../store';
import { withReaction, newStamp, type Stamp } from '../add-take';

/** How far a job is; with null it is over, and what it had shown early leaves the stage. */
export function jobChanged(job: Job | null): Change {
  return () => (job ? { job } : { job, preview: null });
}

/** Part of the coming reaction is on the stage. */
export function previewShown(preview: Preview, previewed: FrameRange): Change {
  return ({ job }) => (job ? { preview, job: { ...job, previewed } } : {});
}

/** A reaction is ready: it is shown and becomes a take. */
export function reactionAdded(reaction: Reaction, stamp: Stamp = newStamp()): Change {
  return (state) => ({ ...withReaction(state, reaction, stamp), reaction, job: null, preview: null });
}

export function footLockSet(footLock: boolean): Change {
  return () => ({ footLock });
}

export function qualityMeasured(quality: Quality | null): Change {
  return () => ({ quality });
}

export function referenceLoaded(reference: Reference | null): Change {
  return () => ({ reference });
}
