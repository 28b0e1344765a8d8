import { useEffect, useMemo } from 'react';
import { Slowness } from './slowness';

interface Watch {
  /** Must be called whenever a picture is due. */
  readonly request: () => void;
  /** Must be called for each drawn picture. */
  readonly draw: () => void;
}

/**
 * Watches the rate of pictures, and calls `onSlow` with the rate if it is too low.
 *
 * @param isJudged whether the view is visible and the user does not keep 3D in any case.
 */
export function useSlowness(isJudged: boolean, onSlow: (hz: number) => void): Watch {
  const slowness = useMemo(() => new Slowness(), []);
  useEffect(() => {
    if (!isJudged) slowness.forget();
  }, [slowness, isJudged]);
  return useMemo(() => {
    const request = () => {
      if (!isJudged) return;
      const now = performance.now();
      slowness.request(now);
      const hz = slowness.tooSlow(now);
      if (hz !== null) onSlow(hz);
    };
    return { request, draw: () => slowness.draw(performance.now()) };
  }, [slowness, isJudged, onSlow]);
}
