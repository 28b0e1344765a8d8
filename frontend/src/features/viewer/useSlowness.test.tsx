import { renderHook } from '@testing-library/react';
import { beforeEach, describe, expect, it, onTestFinished, vi } from 'vitest';
import { keep3d } from './keep3d';
import { useSlowness } from './useSlowness';

let now = 0;

beforeEach(() => {
  localStorage.clear();
  now = 0;
  const clock = vi.spyOn(performance, 'now').mockImplementation(() => now);
  onTestFinished(() => clock.mockRestore());
});

/**
 * Requests pictures continuously for four seconds and draws two a second; returns the rates that were too
 * slow.
 */
function watch(isVisible = true) {
  const onSlow = vi.fn();
  const { result } = renderHook(() => useSlowness(isVisible, onSlow));
  for (; now < 4000; now += 50) {
    result.current.request();
    if (now % 500 === 0) result.current.draw();
  }
  return onSlow;
}

describe('the watch on a view', () => {
  it('reports the rate of a view that is too slow, once', () => {
    const onSlow = watch();
    expect(onSlow).toHaveBeenCalledOnce();
    expect(onSlow.mock.lastCall?.[0]).toBeCloseTo(2, 0);
  });

  it('accepts any rate if the user keeps 3D', () => {
    keep3d();
    expect(watch()).not.toHaveBeenCalled();
  });

  it('does not judge a hidden view', () => {
    expect(watch(false)).not.toHaveBeenCalled();
  });
});
