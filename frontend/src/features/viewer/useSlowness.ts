import { useEffect, useMemo } from 'react';
import { keeps3d } from './keep3d';
import { Slowness } from './slowness';

interface Watch {
  /** Must be called whenever a picture is due. */
  readonly request: () => void;
  /** Must be called for each drawn picture. */
  readonly draw: () => void;
}

/**
 * Watches the rate of pictures, and calls `onSlow` with the rate if it is too low, unless the user keeps 3D.
 */
export function useSlowness(isVisible: boolean, onSlow: (hz: number) => void): Watch {
  const slowness = useMemo(() => new Slowness(), []);
  useEffect(() => {
    const forget = () => slowness.forget();
    if (!isVisible) forget();
    document.addEventListener('visibilitychange', forget);
    return () => document.removeEventListener('visibilitychange', forget);
  }, [slowness, isVisible]);
  return useMemo(() => {
    const request = () => {
      if (!isVisible || document.hidden) return;
      const now = performance.now();
      slowness.request(now);
      const hz = keeps3d() ? null : slowness.tooSlow(now);
      if (hz !== null) onSlow(hz);
    };
    return { request, draw: () => slowness.draw(performance.now()) };
  }, [slowness, isVisible, onSlow]);
}
