/** Where joints lie between the points of a body that are seen in pictures: the middle of the ears, the tips of the toes. */

/** Neck: from the middle of the hips to that of the shoulders, and beyond. */
export const NECK_UP = 1.08;
/** Head: from the neck to the middle of the ears. */
export const HEAD_SHARE = 0.6;
/** Ball of the foot: from the ankle to the tip of the toes. */
export const BALL_SHARE = 0.62;
