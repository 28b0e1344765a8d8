import { create } from 'zustand';
import type { Fault, ServerMessage, Snapshot, Tick, Tree } from '@/generated/messages';
import { useLiveStore } from '@/store/project/live';
import { initialSession, reduceAll } from './reduce';
import type { SessionData } from './types';

export const useSessionStore = create<SessionData>(() => initialSession);

const HIDDEN_FLUSH_MS = 200;

let queue: ServerMessage[] = [];
let isScheduled = false;

/** Queues a message; all that arrive within one animation frame change the page once. */
export function receive(message: ServerMessage): void {
  queue.push(message);
  if (isScheduled) return;
  isScheduled = true;
  // A hidden page gets no animation frames, and its queue must not grow.
  if (document.hidden) setTimeout(flush, HIDDEN_FLUSH_MS);
  else requestAnimationFrame(flush);
}

export function flush(): void {
  isScheduled = false;
  const messages = queue;
  queue = [];
  if (messages.length === 0) return;
  useSessionStore.setState((state) => reduceAll(state, messages));
  for (const message of messages) showLive(message);
}

/** Passes on to the canvas what concerns the blocks. */
function showLive({ command, data }: ServerMessage): void {
  const live = useLiveStore.getState();
  switch (command) {
    case 'tree':
      return live.setTree((data as Tree).nodes);
    case 'snapshot': {
      const { tree, statuses, faults } = data as Snapshot;
      live.setTree(tree?.nodes ?? []);
      live.setStatuses(statuses);
      return faults.forEach(showFault);
    }
    case 'tick': {
      const { changed, flashed } = data as Tick;
      if (changed.length > 0) live.setStatuses(changed);
      if (flashed.length > 0) live.flash(flashed);
      return;
    }
    case 'fault':
      return showFault(data as Fault);
  }
}

function showFault(fault: Fault): void {
  if (fault.node_id) useLiveStore.getState().setFault(fault.node_id, fault.tree_id, fault.message);
}

export function resetSession(change: Partial<SessionData> = {}): void {
  queue = [];
  const { tickHz, speed, projectId, logs, nextLogId } = useSessionStore.getState();
  // What was printed can still be read after the session has ended.
  useSessionStore.setState({ ...initialSession, tickHz, speed, projectId, logs, nextLogId, ...change }, true);
  useLiveStore.getState().clear();
}
