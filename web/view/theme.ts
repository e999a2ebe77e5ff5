import type { Theme } from '../common/picture';

/** Everything on the stage that differs between the dark and the light theme. */
export interface Look {
  readonly leader: number;
  readonly reactor: number;
  /** The reactor's coarse layer alone, and another take of the reactor. */
  readonly coarse: number;
  readonly other: number;
  /** Stands out from the background: the middle of a hand link, and bones. */
  readonly contrast: number;
  readonly background: number;
  /** Colour of the lit floor in the middle. */
  readonly litFloor: number;
  readonly line: number;
  readonly lineOpacity: number;
  readonly fill: number;
  readonly sky: number;
  readonly ground: number;
  readonly hemisphere: number;
  readonly key: number;
  readonly rim: number;
  readonly shadow: number;
  /** Opacity of the contact shadow under a foot on the floor. */
  readonly contact: number;
}

export const LOOKS: Readonly<Record<Theme, Look>> = {
  dark: {
    leader: 0x2f79b5,
    reactor: 0xf08a4b,
    coarse: 0xffb27d,
    other: 0xf0705a,
    contrast: 0xf4f1ec,
    background: 0x121417,
    litFloor: 0x1e2226,
    line: 0xffffff,
    lineOpacity: 0.17,
    fill: 0.75,
    sky: 0xdfe8f2,
    ground: 0x5a5f68,
    hemisphere: 1.5,
    key: 2.7,
    rim: 1.4,
    shadow: 0.62,
    contact: 0.55,
  },
  light: {
    leader: 0x2672ab,
    reactor: 0xe97e42,
    coarse: 0xe06a22,
    other: 0xc8432c,
    contrast: 0x2b3036,
    background: 0xe9ebed,
    litFloor: 0xf6f7f8,
    line: 0x5c646d,
    lineOpacity: 0.2,
    fill: 1,
    sky: 0xffffff,
    ground: 0xb9bec5,
    hemisphere: 2.05,
    key: 2.6,
    rim: 0.5,
    shadow: 0.3,
    contact: 0.3,
  },
};
