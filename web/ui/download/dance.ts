import { type Role, otherRole } from '../../common/role';
import { atFrameRate, type Dance, partOf } from '../../export/client';
import type { MotionClip } from '../../motion/skeleton/clip';
import { withLevelHead } from '../../motion/skeleton/level-head';
import { generatedRole } from '../store/roles';
import { type FileNameParts, pictureFileName, videoFileName } from './file-name';
import { reactorMotion } from '../store/reactor-motion';
import type { AppState, DancerSelection, Saved } from '../store/state';
import type { Span } from '../store/time-scale';
import { takeOnStage, takeTitle } from '../store/take';

/** What the file names of the reaction on the stage are made from; null without a reaction. */
export function fileNameParts(state: AppState): FileNameParts | null {
  const { reaction, footLock, download } = state;
  return (
    reaction && {
      inputs: reaction.inputs,
      footLock,
      take: titleOnStage(state),
      part: chosenPart(state),
      rate: download.rate,
    }
  );
}

/** The loop, seconds, if it is chosen to be written and in the dance of the reaction; null for the whole dance. */
export function chosenPart({ reaction, download, playback: { region } }: AppState): Span | null {
  if (!reaction || !region || download.part === 'whole') return null;
  const { fps, frames } = reaction.inputs.leader.file.clip;
  return region.to <= frames / fps ? region : null;
}

/** The frames of the reaction's dance that are chosen to be written, the last one excluded. */
export function chosenFrames(state: AppState, { fps, frames }: Pick<MotionClip, 'fps' | 'frames'>): Span {
  const part = chosenPart(state);
  if (!part) return { from: 0, to: frames };
  return { from: Math.round(part.from * fps), to: Math.min(frames, Math.round(part.to * fps)) };
}

/** `Take 3`, or what it was named; null for a reaction whose take was deleted. */
function titleOnStage(state: AppState): string | null {
  const take = takeOnStage(state);
  return take && takeTitle(take);
}

/** The file that was written last, if it is the video of the reaction on the stage in the chosen size. */
export function savedVideo(state: AppState, container: string): Saved | null {
  const { saved, download } = state;
  const named = fileNameParts(state);
  return named && saved?.name === videoFileName(named, download.size, container) ? saved : null;
}

/** The file that was written last, if it is the picture of this moment of the reaction in the chosen size. */
export function savedPicture(state: AppState): Saved | null {
  const { saved, download, playback } = state;
  const named = fileNameParts(state);
  return named && saved?.name === pictureFileName(named, download.size, playback.time) ? saved : null;
}

/** The role of the generated dancer that would be written. */
function writtenRole(state: AppState): Role {
  return state.reaction?.inputs.settings.role ?? generatedRole(state);
}

/** The role of the dancer that is chosen to be written, or both. */
export function chosenRole(state: AppState): Role | 'both' {
  const { who } = state.download;
  if (who === 'both') return who;
  return who === 'generated' ? writtenRole(state) : otherRole(writtenRole(state));
}

/** The choice that means this role now. */
export function selectionOf(role: Role | 'both', state: AppState): DancerSelection {
  if (role === 'both') return role;
  return role === writtenRole(state) ? 'generated' : 'loaded';
}

/** The motions to be written: both dancers on the stage or one of them, as chosen; null without a reaction. */
export function chosenDance(state: AppState): Dance | null {
  const { reaction, footLock, download } = state;
  const who = chosenRole(state);
  const motion = reactorMotion(state);
  if (!reaction || !motion) return null;
  const { song, leader, shift, settings } = reaction.inputs;
  const made = { role: settings.role, motion };
  const loaded = { role: otherRole(settings.role), motion: leader.motion };
  const dancers: Dance['dancers'] = made.role === 'reactor' ? [loaded, made] : [made, loaded];
  const dance: Dance = {
    dancers: dancers
      .filter(({ role }) => who === 'both' || role === who)
      .map(({ role, motion }) => ({ role, motion: withLevelHead(motion) })),
    about: {
      song: song?.name ?? null,
      leader: leader.name,
      take: titleOnStage(state),
      model: reaction.model ? { id: reaction.model.id, name: reaction.model.name } : null,
      settings,
      shift,
      footLock,
    },
  };
  const { from, to } = chosenFrames(state, motion);
  return atFrameRate(partOf(dance, from, to), download.rate);
}
