import type { SessionInfo } from '@/api/types';
import { attachedPath, navigate } from '.';

let begun: SessionInfo | null = null;

/** Goes to the page of a session that this page has just begun, which need not ask the server for it again. */
export function openBegun(session: SessionInfo): void {
  begun = session;
  navigate(attachedPath(session.id));
}

/** Returns the session of an id if it has just begun, once: later its state may be another one. */
export function takeBegun(sessionId: string): SessionInfo | null {
  const found = begun?.id === sessionId ? begun : null;
  begun = null;
  return found;
}
