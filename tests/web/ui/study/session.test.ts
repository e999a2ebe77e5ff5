import { describe, expect, test } from 'vitest';
import {
  answersTo,
  firstOpen,
  type Session,
  SavedSession,
  withAnswer,
} from '../../../../web/ui/study/session';

const empty: Session = {
  participant: 'Ana',
  set: 'built-in',
  content: 'demo: mirror, ours',
  seed: 5,
  pairs: [
    { duet: 'demo', left: 'ours', right: 'mirror' },
    { duet: 'slow', left: 'mirror', right: 'ours' },
  ],
  answers: [],
  finished: false,
};

function memory(): Pick<Storage, 'getItem' | 'setItem' | 'removeItem'> & { all: Map<string, string> } {
  const all = new Map<string, string>();
  return {
    all,
    getItem: (key) => all.get(key) ?? null,
    setItem: (key, value) => void all.set(key, value),
    removeItem: (key) => void all.delete(key),
  };
}

describe('a participant’s session', () => {
  test('holds one answer a question, the last one given', () => {
    let session = withAnswer(empty, 1, 'music', 2, 3);
    session = withAnswer(session, 1, 'music', -1, 5);
    session = withAnswer(session, 1, 'naturalness', 0, 6);
    expect(session.answers).toHaveLength(2);
    expect(answersTo(session, 1)).toEqual(
      new Map([
        ['music', -1],
        ['naturalness', 0],
      ]),
    );
    expect(answersTo(session, 0).size).toBe(0);
    expect(session.answers[0]).toEqual({
      ...{ participant: 'Ana', set: 'built-in', seed: 5, pair: 2, duet: 'slow', left: 'mirror' },
      ...{ right: 'ours', criterion: 'music', score: -1, seconds: 5 },
    });
  });

  test('goes on with the first pair that is not answered completely', () => {
    const three = (): number => 3;
    expect(firstOpen(empty, three)).toBe(0);
    let session = empty;
    for (const criterion of ['naturalness', 'music', 'interaction'] as const)
      session = withAnswer(session, 0, criterion, 1, 1);
    expect(firstOpen(session, three)).toBe(1);
    expect(firstOpen(session, ({ duet }) => (duet === 'demo' ? 3 : 0))).toBe(2);
  });

  test('is kept until it is forgotten', () => {
    const storage = memory();
    const session = withAnswer(empty, 0, 'interaction', 1, 2.5);
    expect(new SavedSession(() => storage).write(session)).toBe(true);
    const kept = new SavedSession(() => storage);
    expect(kept.read()).toEqual(session);
    kept.forget();
    expect(kept.read()).toBeNull();
  });

  test('is not finished where an earlier version of the page has kept it', () => {
    const storage = memory();
    const { finished, ...earlier } = empty;
    storage.all.set('reactdance-study', JSON.stringify(earlier));
    expect(new SavedSession(() => storage).read()).toEqual({ ...earlier, finished });
  });

  test.each(['no JSON', '{"participant":1}', '[]', JSON.stringify({ ...empty, seed: 0.5 })])(
    'is not read from %j',
    (text) => {
      const storage = memory();
      storage.all.set('reactdance-study', text);
      expect(new SavedSession(() => storage).read()).toBeNull();
    },
  );

  test('says where it can’t be kept', () => {
    const forbidden = new SavedSession(() => {
      throw new DOMException('forbidden', 'SecurityError');
    });
    expect(forbidden.read()).toBeNull();
    expect(forbidden.write(empty)).toBe(false);
    // It is there as long as the page is open.
    expect(forbidden.read()).toBe(empty);
    forbidden.forget();
    expect(forbidden.read()).toBeNull();
  });
});
