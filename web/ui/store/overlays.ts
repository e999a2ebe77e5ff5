import type { VisibleOverlays } from '../../common/visible-overlays';

/** Something the stage can draw in addition to the dancers: its name on the page, the key that toggles it, a hint. */
export interface Overlay {
  readonly what: keyof VisibleOverlays;
  readonly label: string;
  readonly key: string;
  readonly hint: string;
}

export const OVERLAYS: readonly Overlay[] = [
  { what: 'ghost', label: 'Coarse ghost', key: 'G', hint: 'The partner without the fine layer' },
  { what: 'skeleton', label: 'Skeleton', key: 'K', hint: 'Bones and joints inside the bodies' },
  { what: 'trails', label: 'Trails', key: 'P', hint: 'Where hands and feet have just been' },
  { what: 'contacts', label: 'Foot contacts', key: 'N', hint: 'Rings under feet that stand' },
  { what: 'facing', label: 'Facing', key: 'W', hint: 'Which way each dancer faces' },
  { what: 'hands', label: 'Hand links', key: 'H', hint: 'Lines between hands within reach' },
];
