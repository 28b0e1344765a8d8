import { act, renderHook } from '@testing-library/react';
import { beforeEach, expect, it, onTestFinished, vi } from 'vitest';
import { findTarget, useTarget } from './useTarget';

/** Puts an element with a place into the page: jsdom has no layout. */
function put(testId: string, left: number, isVisible = true): HTMLElement {
  const element = document.body.appendChild(document.createElement('div'));
  element.dataset['testid'] = testId;
  element.checkVisibility = () => isVisible;
  element.getBoundingClientRect = () => new DOMRect(left, 10, 50, 20);
  return element;
}

beforeEach(() => {
  vi.stubGlobal(
    'DOMRect',
    class {
      constructor(
        readonly left: number,
        readonly top: number,
        readonly width: number,
        readonly height: number,
      ) {}
    },
  );
  onTestFinished(() => {
    document.body.innerHTML = '';
    vi.unstubAllGlobals();
    vi.useRealTimers();
  });
});

it('is the best place that can be seen, else the canvas', () => {
  expect(findTarget('run')).toBeNull();
  put('canvas', 300);
  const palette = put('palette', 20, false);
  expect(findTarget('block')).toMatchObject({ left: 300, isFarOff: true });
  palette.checkVisibility = () => true;
  expect(findTarget('block')).toMatchObject({ left: 20, width: 50, isFarOff: false });
  put('ghost-block', 400);
  expect(findTarget('block')).toMatchObject({ left: 400 });
});

it('does not see what is scrolled away', () => {
  put('run', 5000);
  expect(findTarget('run')).toBeNull();
});

it('is followed as it moves', () => {
  vi.useFakeTimers();
  const run = put('run', 100);
  const { result } = renderHook(() => useTarget('run'));
  const first = result.current;
  expect(first).toMatchObject({ left: 100 });
  act(() => void vi.advanceTimersByTime(1000));
  expect(result.current).toBe(first);
  run.getBoundingClientRect = () => new DOMRect(140, 10, 50, 20);
  act(() => void vi.advanceTimersByTime(1000));
  expect(result.current).toMatchObject({ left: 140 });
});
