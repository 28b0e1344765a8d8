import { expect, it } from 'vitest';
import i18next from 'i18next';
import { adviceOf, labelOf } from './markTexts';

const t = i18next.getFixedT('en', 'axis');

it('tells what a mark is, and who set a flag', () => {
  expect(labelOf(t, { kind: 'fault', t: 1, text: 'ValueError\nmore' })).toBe('Fault at 1.00 s: ValueError');
  expect(labelOf(t, { kind: 'flag', t: 1, text: 'here', user: '' })).toBe('Flag at 1.00 s: here');
  expect(labelOf(t, { kind: 'flag', t: 1, text: 'here', user: 'Ada' })).toBe('Flag of Ada at 1.00 s: here');
});

it('tells what is missing where the recording stopped, and what can be done', () => {
  const mark = { kind: 'stopped', t: 1, text: 'No space left' } as const;
  expect(adviceOf(t, { ...mark, stop: { reason: 'disk_full', goes_on: false } })).toMatch(
    /missing.*Free some disk space/,
  );
  expect(adviceOf(t, { ...mark, stop: { reason: 'recorder_died', goes_on: true } })).toMatch(
    /Another recorder/,
  );
  expect(adviceOf(t, mark)).toMatch(/Another recorder/);
  expect(adviceOf(t, { kind: 'flag', t: 1, text: '' })).toBe('');
});
