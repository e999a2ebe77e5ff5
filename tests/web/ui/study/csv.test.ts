import { describe, expect, test } from 'vitest';
import { type Answer, withoutRepeats } from '../../../../web/ui/study/answers';
import { answersCsv, readAnswers, summaryCsv } from '../../../../web/ui/study/csv';
import { summarise } from '../../../../web/ui/study/summary';

const answers: Answer[] = [
  {
    ...{ participant: 'Ana, "the first"', set: 'files', seed: 7, pair: 1, duet: 'salsa', left: 'ours' },
    ...{ right: 'edge', criterion: 'naturalness', score: -2, seconds: 12.3 },
  },
  {
    ...{ participant: '=1+1', set: 'files', seed: 7, pair: 2, duet: 'a\nb', left: 'truth', right: 'ours' },
    ...{ criterion: 'music', score: 0, seconds: 4 },
  },
];

describe('answers as a table', () => {
  test('are read as they were written', () => {
    expect(readAnswers(answersCsv(answers))).toEqual(answers);
    expect(readAnswers(`\uFEFF${answersCsv(answers).replaceAll('\r\n', '\n')}`)).toEqual(answers);
    expect(readAnswers(answersCsv([]))).toEqual([]);
  });

  test('name the preferred method, quote what needs it, and hold no formulas', () => {
    expect(answersCsv(answers).split('\r\n')).toEqual([
      'participant,set,seed,pair,duet,left,right,criterion,score,preferred,seconds',
      '"Ana, ""the first""",files,7,1,salsa,ours,edge,naturalness,-2,ours,12.3',
      `"'=1+1",files,7,2,"a\nb",truth,ours,music,0,none,4`,
      '',
    ]);
  });

  test.each([
    ['another table', 'a,b\r\n1,2\r\n', /first line/],
    ['a row that is cut off', `${answersCsv(answers)}Ana,files\r\n`, /line 4 is damaged/],
    ['an open quote', answersCsv(answers).replace('first"""', 'first'), /line 3 is damaged/],
    ['a score of 3', answersCsv(answers).replace('-2,ours', '3,ours'), /line 2 has a number/],
    ['no score', answersCsv(answers).replace('-2,ours', ',ours'), /line 2 has a number/],
    ['no number', answersCsv(answers).replace('12.3', 'soon'), /line 2 has a number/],
    [
      'another question',
      answersCsv(answers).replace('naturalness', 'taste'),
      /line 2 has an unknown question/,
    ],
  ])('%s is refused', (_, text, reason) => {
    expect(() => readAnswers(text)).toThrow(reason);
  });

  test('damaged tables are refused or read, never anything else', () => {
    const text = answersCsv(answers);
    for (let seed = 0; seed < 500; seed++) {
      const at = (seed * 37) % text.length;
      const damaged = text.slice(0, at) + ['"', ',', '\r\n', '\u0000', ''][seed % 5]! + text.slice(at + 1);
      try {
        for (const { score } of readAnswers(damaged)) expect(Math.abs(score)).toBeLessThanOrEqual(2);
      } catch (error) {
        expect(error).toMatchObject({ code: 'not-answers' });
      }
    }
  });
});

test('answers of a file that is chosen twice count once, and those of other participants all', () => {
  const other = { ...answers[0]!, seconds: 12.4 };
  const read = [...readAnswers(answersCsv(answers)), ...readAnswers(answersCsv([...answers, other]))];
  expect(withoutRepeats(read)).toEqual([...answers, other]);
});

test('the summary as a table', () => {
  const [titles, line] = summaryCsv(summarise(answers, 'ours')).split('\r\n');
  expect(titles).toBe(
    'method,against,criterion,answers,wins,equal,losses,win_rate,low_95,high_95,mean_score',
  );
  expect(line).toBe('ours,edge,naturalness,1,1,0,0,1,0.2065,1,2');
});
