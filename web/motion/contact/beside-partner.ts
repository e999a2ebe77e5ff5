import type { MotionClip, SolvedMotion } from '../skeleton/clip';
import { bringDown } from './bring-down';
import type { BodyRule } from './capsules';
import { avoidCollisions } from './collision-avoidance';
import { liftFeet } from './floor-clearance';
import { withFootsteps } from './footsteps';
import { holdHands } from './hand-hold';
import { separateLegs } from './leg-separation';
import { type GlideRule, limitRootSpeed } from './root-speed';

/**
 * What a dancer keeps to beside a partner: moved out of the partner's body, no faster over the floor than dancers go,
 * brought down where they stay off the floor, stepping where both feet would slide, with legs out of each other, feet out
 * of the floor, and, unless it is switched off, hands that go with the partner's hands near them. Pure.
 *
 * The speed is limited before collisions are avoided, since the slower path of who should circle a spinning partner leads
 * through that partner, and afterwards, since the shifts against collisions are fast as well.
 *
 * @param partner of the same frames and rate
 * @param rules capsules of both bodies, and how fast a root may be
 * @param steps that have been taken by each frame where the dancer steps, `stepCounts`
 * @param options `holding`: whether hands hold the partner's
 */
export function besidePartner(
  motion: SolvedMotion,
  partner: MotionClip,
  rules: { readonly penetration: BodyRule; readonly glide: GlideRule },
  steps: Float64Array,
  { holding = true }: { readonly holding?: boolean | undefined } = {},
): SolvedMotion {
  const slow = limitRootSpeed(motion, partner, rules.glide);
  const apart = avoidCollisions(slow, partner, rules.penetration);
  const down = bringDown(limitRootSpeed(apart, partner, rules.glide));
  const whole = liftFeet(separateLegs(withFootsteps(down, steps)));
  return holding ? holdHands(whole, partner) : whole;
}
