import type { Dance } from '../../../web/export/dance';
import { madeDancer } from './made-dancer';

/** A duet of made dancers, or one of them; its song has a name with characters outside ASCII. */
export function madeDance(frames: number, ...roles: ('leader' | 'reactor')[]): Dance {
  const seeds = { leader: 1, reactor: 2 };
  return {
    dancers: roles.map((role) => ({ role, motion: madeDancer({ frames, seed: seeds[role], spin: 0.3 }) })),
    about: {
      song: 'Señor “Patio” 舞.mp3',
      leader: 'leader_0412.bvh',
      take: 'Softer hands',
      model: { id: 'salsa', name: 'Salsa' },
      settings: { guidance: { coarse: 1.2, fine: 0.6 }, seed: 1204 },
      shift: 0,
      footLock: true,
    },
  };
}
