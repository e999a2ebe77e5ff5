/** The two parts of a dance, in the order in which they are listed everywhere. */
export const ROLES = ['leader', 'reactor'] as const;
export type Role = (typeof ROLES)[number];

export function otherRole(role: Role): Role {
  return role === 'leader' ? 'reactor' : 'leader';
}
