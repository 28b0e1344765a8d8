import { trace } from './trace';
import { trail } from './trail';

const KEY = 'bts.run.';

let sessionId: string | null = null;

/**
 * What only this page knows of a run, kept over a reload: the way that the robot went and what the nodes
 * did. The session itself sends everything else again.
 */
function keepRun(): void {
  if (!sessionId) return;
  try {
    sessionStorage.setItem(KEY, JSON.stringify({ sessionId, trail: trail.keep(), history: trace.keep() }));
  } catch {
    // No room: both begin empty after the reload, nothing else is lost.
  }
}

interface Kept {
  sessionId: string;
  trail: string;
  /** Named before the trace had its name; pages that were open then still hold it. */
  history: string;
}

let kept: Kept | null = null;

/** From now on the run of this session is kept; what a reload left of it comes back. */
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

/** The trace before a reload or a lost connection; after a reload it is returned once. */
export function takeCachedTrace(): string | null {
  const text = kept?.history ?? null;
  kept = null;
  if (text) return text;
  return trace.nodes.length > 0 ? trace.keep() : null;
}

window.addEventListener('pagehide', keepRun);
