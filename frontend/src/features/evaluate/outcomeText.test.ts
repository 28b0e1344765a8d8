import { expect, it } from 'vitest';
import i18next from 'i18next';
import '@/i18n/editorTexts';
import { outcome } from '../../../harness/evaluations';
import { duration, outcomeText, percent, short } from './outcomeText';

const t = i18next.getFixedT('en', 'evaluate');

it('says seed, outcome, time and margin of a cell', () => {
  expect(outcomeText(t, 3, outcome(3))).toBe('Seed 3: success after 20 s, margin 0.5 m');
  expect(outcomeText(t, 3, outcome(3, { outcome: 'crashed', margin: null }))).toBe(
    'Seed 3: crashed after 20 s',
  );
  expect(outcomeText(t, 9, undefined)).toBe('Seed 9: not run yet');
});

it.each([
  [3.4, '3 s'],
  [61, '1 min 1 s'],
  [7380, '2 h 3 min'],
])('says that %f s are %s', (seconds, words) => {
  expect(duration(seconds)).toBe(words);
});

it('writes numbers short', () => {
  expect([short(0.123456), short(12), percent(0.9567)]).toEqual(['0.123', '12', '95.7 %']);
});
