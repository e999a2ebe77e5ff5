import { expect, test } from 'vitest';
import { readAscii } from '../../../../../web/motion/import/fbx/ascii';

test('what a mesh holds is left out, with what that holds, and nothing after it', () => {
  const text = '; a comment\nObjects: { Geometry: 1, "body" { Pose: { a: 2 } b: 3 } Model: 4 { c: 5 } }';
  expect(readAscii(text)).toEqual([
    {
      name: 'Objects',
      values: [],
      children: [
        { name: 'Geometry', values: [1, 'body'], children: [] },
        { name: 'Model', values: [4], children: [{ name: 'c', values: [5], children: [] }] },
      ],
    },
  ]);
});

test.each([
  ['{', 'a brace opens nothing'],
  ['a: 1 }', 'a brace closes nothing'],
  ['a: { b: {} {} }', 'a brace opens nothing'],
  ['a: { Geometry: {', 'it ends too early'],
])('braces that do not match: %s', (text, problem) => {
  expect(() => readAscii(text)).toThrow(`The FBX file is damaged: ${problem}.`);
});
