/** The reaction, its progress and its measures. */
import type { Reaction } from '../reaction';
import type { Job, Preview, Quality, Reference } from '../state';
import type { Change } from '../store';
import { withReaction, newStamp, type TakeStamp } from '../add-take';

/** Progress of a job; null ends it and removes its preview from the stage. */
export function jobChanged(job: Job | null): Change {
  return () => (job ? { job } : { job, preview: null });
}

/** Puts a part of the next reaction on the stage. */
export function previewShown(preview: Preview): Change {
  return () => ({ preview });
}

/** Shows a finished reaction and makes it a take. */
export function reactionAdded(reaction: Reaction, stamp: TakeStamp = newStamp()): Change {
  return (state) => ({ ...withReaction(state, reaction, stamp), reaction, job: null, preview: null });
}

/** The reaction with this motion was shown before its song or its model was there: now it has them, wherever it is. */
export function reactionCompleted(reaction: Reaction): Change {
  return ({ takes, reaction: shown, history }) => ({
    takes: takes.map((take) => (take.reaction.motion === reaction.motion ? { ...take, reaction } : take)),
    reaction: shown?.motion === reaction.motion ? reaction : shown,
    history,
  });
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
