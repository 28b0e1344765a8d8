import { trace } from './trace';
import { trail } from './trail';

const KEY = 'bts.run.';

let sessionId: string | null = null;

/**
 * Keeps data that only this page has over a reload: the robot's trail, and the trace of the nodes. The
 * session sends everything else again.
 */
function keepRun(): void {
  if (!sessionId) return;
  try {
    sessionStorage.setItem(KEY, JSON.stringify({ sessionId, trail: trail.keep(), history: trace.keep() }));
  } catch {
    // The browser's storage is full: trail and trace start empty after the reload.
  }
}

interface Kept {
  sessionId: string;
  trail: string;
  /** The old name of the field, which pages that were opened before an update still store. */
  history: string;
}

let kept: Kept | null = null;

/** Starts to keep the run of this session, and restores what a reload left of it. */
export function rememberRun(id: string): void {
  if (id === sessionId) return;
  if (sessionId) trail.clear();
  sessionId = id;
  try {
    kept = JSON.parse(sessionStorage.getItem(KEY) ?? 'null') as Kept | null;
  } catch {
    kept = null;
  }
  sessionStorage.removeItem(KEY);
  if (kept?.sessionId !== id) kept = null;
  trail.restore(kept?.trail ?? null);
}

export function forgetRun(): void {
  sessionId = null;
  kept = null;
  trail.clear();
  trace.start([], 0);
}

/** After a reload the trace from before it, but only once; otherwise the present trace, for a reconnection. */
export function takeCachedTrace(): string | null {
  const text = kept?.history ?? null;
  kept = null;
  if (text) return text;
  return trace.nodes.length > 0 ? trace.keep() : null;
}

window.addEventListener('pagehide', keepRun);
