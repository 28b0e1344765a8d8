import { useThree } from '@react-three/fiber';
import { useCallback, useEffect, useRef } from 'react';
import { isSoftwareWebGl } from './webgl';

/**
 * The shortest pause in ms between frames of the software renderer, which may use at most a third of the
 * time.
 */
const SHORTEST_PAUSE_MS = 80;
const LONGEST_PAUSE_MS = 1000;
const PAUSE_FOR_COST = 2;
const POLL_MS = 10;

/** Resolves when all drawing so far is finished. */
function drawn(gl: WebGL2RenderingContext): Promise<void> {
  const sync = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
  if (!sync) return Promise.resolve();
  gl.flush();
  return new Promise((resolve) => {
    const poll = () => {
      if (!gl.isContextLost() && gl.getSyncParameter(sync, gl.SYNC_STATUS) !== gl.SIGNALED) {
        setTimeout(poll, POLL_MS);
        return;
      }
      gl.deleteSync(sync);
      resolve();
    };
    setTimeout(poll, 0);
  });
}

/**
 * Returns a function that requests a frame. With software rendering, the next frame waits for the last one
 * and then twice as long again: frames that pile up would freeze the page and starve the simulation.
 */
export function useThrottledInvalidate(): () => void {
  const invalidate = useThree((state) => state.invalidate);
  const renderer = useThree((state) => state.gl);
  const isBusy = useRef(false);
  const isWanted = useRef(false);
  const timer = useRef<ReturnType<typeof setTimeout>>(undefined);
  useEffect(() => () => clearTimeout(timer.current), []);

  return useCallback(() => {
    if (!isSoftwareWebGl()) return invalidate();
    const draw = () => {
      isBusy.current = true;
      isWanted.current = false;
      const start = performance.now();
      invalidate();
      requestAnimationFrame(() => {
        void drawn(renderer.getContext() as WebGL2RenderingContext).then(() => {
          const cost = performance.now() - start;
          timer.current = setTimeout(
            () => {
              isBusy.current = false;
              if (isWanted.current) draw();
            },
            Math.min(LONGEST_PAUSE_MS, Math.max(SHORTEST_PAUSE_MS, cost * PAUSE_FOR_COST)),
          );
        });
      });
    };
    if (isBusy.current) isWanted.current = true;
    else draw();
  }, [invalidate, renderer]);
}
