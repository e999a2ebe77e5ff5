/** How exact the motion from a video is, from what the networks saw in videos whose motion is known. */
import { readFileSync } from 'node:fs';
import { describe, expect, it } from 'vitest';
import { accuracyOf, travels } from '../../support/filmed/accuracy';
import { FILMED, PERSON } from '../../support/filmed/shots';
import { tableRow } from '../../support/filmed/table';

const document = readFileSync(new URL('../../../../docs/leader-from-video.md', import.meta.url), 'utf8');
/** Limits: joints in metres, the path's length as a share, place as a share of the path, standing feet in m/s. */
const MANNEQUIN = { pose: 0.08, path: 0.15, place: 0.15, feet: 0.1 };
// The truth of the person is known to a few centimetres, and their stances last a quarter of a second.
// A camera in a hand: what is measured of its turns trembles a little.
const HELD = { ...MANNEQUIN, feet: 0.2 };
const RECORDED = { pose: 0.11, path: 0.25, place: 0.18, feet: 0.5 };
/** A row's numbers without its title. */
const numbers = (row: string): number[] => [...row.replace(/^\| [^|]*/, '').matchAll(/[\d.]+/g)].map(Number);

describe.each([...FILMED, ...PERSON])('$title, camera at $shot.position.1 m', (filmed) => {
  const found = accuracyOf(filmed);
  const held = filmed.shot.panned === undefined ? MANNEQUIN : HELD;
  const limits = PERSON.includes(filmed) ? RECORDED : held;

  it('has its joints where they were', () => {
    expect(found.pose).toBeLessThan(limits.pose);
  });

  it('faces the way it did', () => {
    expect(found.flipped).toBe(0);
  });

  it('stands where the dancer stood, and goes as far', () => {
    if (!travels(found, filmed)) return expect(found.place).toBeLessThan(0.1);
    expect(found.place / found.travelled).toBeLessThan(limits.place);
    expect(Math.abs(found.found / found.travelled - 1)).toBeLessThan(limits.path);
  });

  it('has feet that stand', () => {
    // In the quick turn the body turns by half over a foot that stands, which people do not do.
    expect(found.feet).toBeLessThan(filmed.motion === 'spinning' ? 0.3 : limits.feet);
  });

  it('has no foot deep in the floor', () => {
    expect(found.sunk).toBeLessThan(0.045);
  });

  it('is in the document as it is', () => {
    const row = numbers(tableRow(filmed, found));
    const same = document.split('\n').filter((line) => {
      const known = numbers(line);
      return line.startsWith(`| ${filmed.title} |`) && known[0] === row[0];
    });
    expect(same).toHaveLength(1);
    // Rounding differs by one between versions of a browser's mathematics.
    numbers(same[0]!).forEach((value, i) => expect(Math.abs(value - row[i]!)).toBeLessThanOrEqual(1));
  });
});
