import { beforeEach, expect, it, vi } from 'vitest';
import { endGuide, finishStep, isGuideNew, startGuide, useGuide } from './guide';

const step = () => useGuide.getState().step;

beforeEach(() => {
  localStorage.clear();
  useGuide.setState({ step: null });
});

it('goes from step to step, each when it was done, and not again', () => {
  expect(isGuideNew()).toBe(true);
  startGuide();
  expect(isGuideNew()).toBe(false);
  expect(finishStep('run')).toBe(false);
  expect(step()).toBe('block');
  expect(finishStep('block')).toBe(false);
  expect(finishStep('fill')).toBe(false);
  expect(step()).toBe('run');
  expect(finishStep('run')).toBe(true);
  expect(step()).toBeNull();
  expect(localStorage.getItem('bts.guide')).toBe('done');
});

it('is skipped permanently, and can be begun again', () => {
  startGuide();
  endGuide();
  expect([step(), isGuideNew()]).toEqual([null, false]);
  startGuide();
  expect(step()).toBe('block');
});

it.each([
  ['fill', 'fill'],
  ['done', null],
  ['x', null],
])('stands in the next visit where %s was kept', async (kept, expected) => {
  localStorage.setItem('bts.guide', kept);
  vi.resetModules();
  const { useGuide: reloaded } = await import('./guide');
  expect(reloaded.getState().step).toBe(expected);
});
