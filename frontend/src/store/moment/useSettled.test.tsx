import { act, renderHook } from '@testing-library/react';
import { afterEach, beforeEach, expect, it, vi } from 'vitest';
import { create } from 'zustand';
import { useSettled } from './useSettled';

const store = create<{ lines: string }>(() => ({ lines: 'a' }));
const read = () => store.getState().lines;
const stores = [store];
let renders = 0;

beforeEach(() => {
  vi.useFakeTimers();
  renders = 0;
  store.setState({ lines: 'a' });
});
afterEach(() => void vi.useRealTimers());

const open = () =>
  renderHook(() => {
    renders += 1;
    return useSettled(read, stores);
  });
const put = (lines: string) => act(() => store.setState({ lines }));

it('shows the first value at once, and of those that follow quickly the last', () => {
  const { result } = open();
  put('b');
  expect(result.current).toBe('b');
  const before = renders;
  for (const lines of ['c', 'd', 'e']) put(lines);
  expect(result.current).toBe('b');
  expect(renders).toBe(before);
  act(() => void vi.advanceTimersByTime(200));
  expect(result.current).toBe('e');
  expect(renders).toBe(before + 1);
});

it('does not render for what did not change, and forgets what is to come when it ends', () => {
  const { result, unmount } = open();
  const before = renders;
  put('a');
  expect(renders).toBe(before);
  put('b');
  put('c');
  unmount();
  act(() => void vi.advanceTimersByTime(200));
  expect(result.current).toBe('b');
});
