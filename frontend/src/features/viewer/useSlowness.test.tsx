import { renderHook } from '@testing-library/react';
import { beforeEach, describe, expect, it, onTestFinished, vi } from 'vitest';
import { useSlowness } from './useSlowness';

let now = 0;

beforeEach(() => {
  now = 0;
  const clock = vi.spyOn(performance, 'now').mockImplementation(() => now);
  onTestFinished(() => clock.mockRestore());
});

/**
 * Requests pictures continuously for four seconds and draws two a second; returns the rates that were too
 * slow.
 */
function watch(isJudged = true) {
  const onSlow = vi.fn();
  const { result } = renderHook(() => useSlowness(isJudged, onSlow));
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

  it('does not judge a hidden view, or one that the user keeps', () => {
    expect(watch(false)).not.toHaveBeenCalled();
  });
});
