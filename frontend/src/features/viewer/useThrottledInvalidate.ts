import { useThree } from '@react-three/fiber';
import { useCallback, useEffect, useRef } from 'react';
import { isSoftwareWebGl } from './webgl';

const SOFTWARE_FRAME_MS = 80;

/** Asks for a frame; where the processor draws, not more often than it can afford. */
export function useThrottledInvalidate(): () => void {
  const invalidate = useThree((state) => state.invalidate);
  const timer = useRef<ReturnType<typeof setTimeout>>(undefined);
  useEffect(() => () => clearTimeout(timer.current), []);
  return useCallback(() => {
    if (!isSoftwareWebGl()) return invalidate();
    timer.current ??= setTimeout(() => {
      timer.current = undefined;
      invalidate();
    }, SOFTWARE_FRAME_MS);
  }, [invalidate]);
}
