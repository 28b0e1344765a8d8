import { trace } from './trace';
import { trail } from './trail';

const KEY = 'bts.run.';

let sessionId: string | null = null;

/**
 * Stores the data that only this page has before a reload: the robot's trail, and the trace of the nodes. The
 * session sends everything else again.
 */
function keepRun(): void {
  if (!sessionId) return;
  try {
    sessionStorage.setItem(KEY, JSON.stringify({ sessionId, trail: trail.keep(), history: trace.keep() }));
  } catch {
    // The browser's storage is full: after the reload, trail and trace start empty.
  }
}

interface Kept {
  sessionId: string;
  trail: string;
  /**
   * The trace. The field keeps its old name, since pages that were opened before an update still store it.
   */
  history: string;
}

let kept: Kept | null = null;

/** Starts to store the run of this session, and restores what was stored before a reload. */
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

/**
 * Returns the trace from before a reload, but only once; afterwards the current trace, for a reconnection.
 */
export function takeCachedTrace(): string | null {
  const text = kept?.history ?? null;
  kept = null;
  if (text) return text;
  return trace.nodes.length > 0 ? trace.keep() : null;
}

window.addEventListener('pagehide', keepRun);
