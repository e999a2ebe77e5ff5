/** The course of one participant: the plan, the answers so far, and where they are kept. */
import * as v from 'valibot';
import { type Answer, CRITERIA, type Criterion } from './answers';
import type { Pair } from './plan';

const KEY = 'reactdance-study';

const text = v.pipe(v.string(), v.maxLength(200));
const whole = v.pipe(v.number(), v.integer());

const schema = v.object({
  participant: text,
  /** Name of the set of dances, and all its duets with their methods. */
  set: text,
  content: v.string(),
  seed: whole,
  pairs: v.array(v.object({ duet: text, left: text, right: text })),
  answers: v.array(
    v.object({
      participant: text,
      set: text,
      seed: whole,
      pair: v.pipe(whole, v.minValue(1)),
      duet: text,
      left: text,
      right: text,
      criterion: v.picklist(CRITERIA.map(({ id }) => id)),
      score: v.pipe(whole, v.minValue(-2), v.maxValue(2)),
      seconds: v.number(),
    }),
  ),
  finished: v.optional(v.boolean(), false),
});

/** One participant's study, as it is kept. */
export interface Session {
  readonly participant: string;
  readonly set: string;
  readonly content: string;
  readonly seed: number;
  readonly pairs: readonly Pair[];
  readonly answers: readonly Answer[];
  /** The last pair was left with all questions answered. */
  readonly finished: boolean;
}

/** The part of localStorage that is needed. */
type Store = Pick<Storage, 'getItem' | 'setItem' | 'removeItem'>;

/** The answer to a question, in the place of one before it. */
export function withAnswer(
  session: Session,
  number: number,
  criterion: Criterion,
  score: number,
  seconds: number,
): Session {
  const { participant, set, seed, pairs, answers } = session;
  const answer: Answer = {
    ...pairs[number]!,
    ...{ participant, set, seed, pair: number + 1, criterion, score, seconds },
  };
  const others = answers.filter((one) => one.pair !== answer.pair || one.criterion !== criterion);
  return { ...session, answers: [...others, answer] };
}

/** The answers to one pair, by criterion. */
export function answersTo({ answers }: Session, number: number): ReadonlyMap<Criterion, number> {
  return new Map(
    answers.filter(({ pair }) => pair === number + 1).map(({ criterion, score }) => [criterion, score]),
  );
}

/** The first pair that has fewer answers than questions; the number of pairs where there is none. */
export function firstOpen(session: Session, questions: (pair: Pair) => number): number {
  const open = session.pairs.findIndex((pair, i) => answersTo(session, i).size < questions(pair));
  return open < 0 ? session.pairs.length : open;
}

/** Keeps a session on this device. Without storage it holds as long as the page is open. */
export class SavedSession {
  /** The session that the storage has refused. */
  #refused: Session | null = null;

  constructor(private readonly storage: () => Store) {}

  /** The session whose answers are not saved, or null; what is kept and is no session is left out. */
  read(): Session | null {
    if (this.#refused) return this.#refused;
    try {
      const result = v.safeParse(schema, JSON.parse(this.storage().getItem(KEY) ?? 'null'));
      return result.success ? result.output : null;
    } catch {
      return null;
    }
  }

  /** @returns whether it is kept */
  write(session: Session): boolean {
    try {
      this.storage().setItem(KEY, JSON.stringify(session));
      this.#refused = null;
      return true;
    } catch {
      this.#refused = session;
      return false;
    }
  }

  forget(): void {
    this.#refused = null;
    try {
      this.storage().removeItem(KEY);
    } catch {
      // There was no storage.
    }
  }
}
