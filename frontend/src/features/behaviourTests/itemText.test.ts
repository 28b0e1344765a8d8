import { expect, it } from 'vitest';
import i18n from 'i18next';
import '@/i18n';
import { itemText } from './itemText';

it.each([
  ['ticked', 'It is never ticked.'],
  ['halted while RUNNING', 'It is never halted while running.'],
  ['SKIPPED', 'It never returns SKIPPED.'],
  ['branch 2 taken', 'Branch 2 is never taken.'],
  ['branch 1 not taken', 'Branch 1 is always taken.'],
  ['_skipIf true', '_skipIf is never true.'],
  ['_while false', '_while is never false.'],
  ['_onSuccess run', '_onSuccess never runs.'],
  ['something new', 'something new'],
])('says %s in words', (item, text) => {
  expect(itemText(i18n.getFixedT('en', 'behaviourTests'), item)).toBe(text);
});
