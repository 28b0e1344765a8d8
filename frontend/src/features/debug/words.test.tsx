import { renderHook } from '@testing-library/react';
import { expect, it } from 'vitest';
import type { Held } from '@/generated/messages';
import '@/i18n';
import '@/i18n/editorTexts';
import { plainBreakpoint } from '@/model/breakpoints';
import { useForcedWords, useHeldWords, useMomentWords } from './words';

const held = (more: Partial<Held>) =>
  ({ event: 'before', cause: 'breakpoint', status: null, decided: '', why: '', ...more }) as Held;

it.each([
  [held({}), 'before its tick, by a breakpoint.'],
  [
    held({ event: 'after', status: 'RUNNING', cause: 'step' }),
    'after its tick: it returned RUNNING, since a step ended.',
  ],
  [
    held({ event: 'decided', status: 'SKIPPED', decided: '_skipIf' }),
    'without a tick: _skipIf decided SKIPPED, by a breakpoint.',
  ],
  [
    held({ event: 'halted', cause: 'condition', why: 'the condition is wrong' }),
    'after it was halted, the condition is wrong.',
  ],
])('says why a tree is held: %o', (stop, words) => {
  expect(renderHook(useHeldWords).result.current(stop)).toBe(words);
});

it('says when a breakpoint holds the tree', () => {
  const words = renderHook(useMomentWords).result.current;
  const plain = plainBreakpoint('Main', 'a');
  expect(words(plain)).toBe('before its tick');
  expect(
    words({ ...plain, when: 'returns', status: 'FAILURE', condition: 'x > 1', hits: 3, log: 'hi' }),
  ).toBe('when it returns FAILURE · if x > 1 · from hit 3 on · writes “hi”');
});

it('says what is forced', () => {
  const words = renderHook(useForcedWords).result.current;
  const mark = { status: 'SUCCESS', once: false, after: false, alone: false } as const;
  expect(words({ ...mark, once: true })).toBe('SUCCESS is forced once, in place of its tick.');
  expect(words({ ...mark, after: true })).toBe('SUCCESS is forced after its ticks, until it is released.');
  expect(words({ ...mark, status: 'RUNNING' })).toContain('frozen');
  expect(words({ ...mark, alone: true })).toContain('runs alone');
});
