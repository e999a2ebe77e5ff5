import { readFileSync } from 'node:fs';
import { expect, it } from 'vitest';
import { nodeIsSupported } from '../../../tools/install.mjs';

it.each(['20.19.0', '20.20.2', '22.13.0', '22.23.5', '24.0.0', '26.12.1'])(
  'Node %s is supported',
  (version) => {
    expect(nodeIsSupported(version)).toBe(true);
  },
);

it.each(['18.20.8', '20.18.3', '21.7.3', '22.11.0', '22.12.0', '23.11.1'])(
  'Node %s, which a pinned package does not support, is refused',
  (version) => {
    expect(nodeIsSupported(version)).toBe(false);
  },
);

it('package.json names the same versions', () => {
  const { engines } = JSON.parse(readFileSync('package.json', 'utf8')) as { engines: { node: string } };
  expect(engines.node).toBe('^20.19.0 || ^22.13.0 || >=24');
});
