import type { LeaderReport } from '../../../motion/retarget/leader';

type Joints = Pick<LeaderReport, 'joints' | 'estimated' | 'retargeted'>;

/** Joints that a file lacks. A spine with another number of joints lacks none. */
function missing({ estimated, retargeted }: Joints): string[] {
  return estimated.filter((joint) => !retargeted.includes(joint)).map((joint) => joint.replaceAll('_', ' '));
}

/** How many of the 22 joints a file has, a spine with another number of joints included. */
export function jointCount(report: Joints): number {
  return Object.keys(report.joints).length - missing(report).length;
}

/** Which joints were found in a file: `all found; pelvis and spine placed along its back`. */
export function jointText(report: Joints): string {
  const lacking = missing(report);
  const all = Object.keys(report.joints).length;
  const found =
    lacking.length > 0
      ? `${jointCount(report)} of ${all} found; filled in: ${lacking.join(', ')}`
      : report.retargeted.length > 0
        ? 'all found'
        : `all ${all} found`;
  return report.retargeted.length > 0 ? `${found}; pelvis and spine placed along its back` : found;
}
