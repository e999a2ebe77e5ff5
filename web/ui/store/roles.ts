import type { SolvedMotion } from '../../motion/skeleton/clip';
import { reactorMotion } from './reactor-motion';
import type { AppState, Role } from './state';

/** Whose part the model dances; the loaded dancer has the other one. */
export function generatedRole({ settings }: Pick<AppState, 'settings'>): Role {
  return settings?.role ?? 'reactor';
}

/** Whose part the loaded dancer has. */
export function loadedRole(state: Pick<AppState, 'settings'>): Role {
  return otherRole(generatedRole(state));
}

export function otherRole(role: Role): Role {
  return role === 'leader' ? 'reactor' : 'leader';
}

/** `Leader` or `Reactor`. */
export function roleName(role: Role): string {
  return role === 'leader' ? 'Leader' : 'Reactor';
}

/** The motion of the made dancer that is drawn: what is being made, as far as it is, else what was made. */
export function drawnMotion(state: Pick<AppState, 'preview' | 'reaction' | 'footLock'>): SolvedMotion | null {
  const { preview, footLock } = state;
  if (preview) return footLock ? preview.locked : preview.motion;
  return reactorMotion(state);
}

/** Who dances what on the stage. */
export function dancers(state: AppState): Readonly<Record<Role, SolvedMotion | null>> {
  const loaded = state.leader?.motion ?? null;
  const made = drawnMotion(state);
  return generatedRole(state) === 'reactor'
    ? { leader: loaded, reactor: made }
    : { leader: made, reactor: loaded };
}
