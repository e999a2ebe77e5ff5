import { otherRole, type Role } from '../../common/role';
import type { SolvedMotion } from '../../motion/skeleton/clip';
import { reactorMotion } from './reactor-motion';
import type { AppState } from './state';

/** The role that the model generates; the loaded dancer has the other one. */
export function generatedRole({ settings }: Pick<AppState, 'settings'>): Role {
  return settings?.role ?? 'reactor';
}

/** The role of the dancer that was loaded from a file. */
export function loadedRole(state: Pick<AppState, 'settings'>): Role {
  return otherRole(generatedRole(state));
}

/** `Leader` or `Reactor`. */
export function roleName(role: Role): string {
  return role === 'leader' ? 'Leader' : 'Reactor';
}

/** The motion of the generated dancer that is drawn: the preview of the next reaction, else the present reaction. */
function drawnMotion(state: Pick<AppState, 'preview' | 'reaction' | 'footLock'>): SolvedMotion | null {
  const { preview, footLock } = state;
  if (preview) return footLock ? preview.locked : preview.motion;
  return reactorMotion(state);
}

/** The motions on the stage by role. */
export function dancers(state: AppState): Readonly<Record<Role, SolvedMotion | null>> {
  const loaded = state.leader?.motion ?? null;
  const generated = drawnMotion(state);
  return generatedRole(state) === 'reactor'
    ? { leader: loaded, reactor: generated }
    : { leader: generated, reactor: loaded };
}
