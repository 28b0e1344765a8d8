import { create } from 'zustand';
import type { ServerMessage } from '@/generated/messages';
import { useLiveStore } from '@/store/project/live';
import { feedLastTick } from './trace/lastTick';
import { feedTrace } from './trace/traceFeed';
import { feedDap } from './dap';
import { feedLive, forgetPending, showDueStatuses } from './liveFeed';
import { appendLogs, initialSession, reduceAll } from './reduce';
import { feedTopics } from './topics';
import { feedSource, loseSource } from './trace/tickSource';
import { feedTries, loseJob } from './tries';
import type { SessionData } from './types';
import { feedValues, forgetValues } from './values/live';
import { useShownValues } from './values/shown';

export const useSessionStore = create<SessionData>(() => initialSession);

const HIDDEN_FLUSH_MS = 200;

let queue: ServerMessage[] = [];
let isScheduled = false;

/** Queues a message; the page is updated once for all messages of an animation frame. */
export function receive(message: ServerMessage): void {
  queue.push(message);
  if (isScheduled) return;
  isScheduled = true;
  // A hidden page gets no animation frames, but its queue must not grow.
  if (document.hidden) setTimeout(flush, HIDDEN_FLUSH_MS);
  else requestAnimationFrame(flush);
}

export function flush(): void {
  isScheduled = false;
  const messages = queue;
  queue = [];
  if (messages.length === 0) return;
  useSessionStore.setState((state) => reduceAll(state, messages));
  for (const message of messages) {
    feedLive(message);
    feedTrace(message);
    feedLastTick(message);
    feedTopics(message);
    feedDap(message);
    feedTries(message);
    feedSource(message);
  }
  showDueStatuses();
  feedValues(useSessionStore.getState);
}

// A value that is chosen while time is paused is shown too.
useShownValues.subscribe(() => {
  feedValues(useSessionStore.getState);
});

/** Writes a line from the page itself to the console. */
export function note(text: string): void {
  useSessionStore.setState((state) =>
    appendLogs(state, [
      {
        source: 'manager',
        level: 'warning',
        text,
        node_id: '',
        node_path: '',
        time: state.simTime,
        launch_node: '',
      },
    ]),
  );
}

export function resetSession(change: Partial<SessionData> = {}): void {
  queue = [];
  const { tickHz, speed, projectId, logs, nextLogId } = useSessionStore.getState();
  // The console stays readable after the session has ended.
  useSessionStore.setState({ ...initialSession, tickHz, speed, projectId, logs, nextLogId, ...change }, true);
  forgetPending();
  loseJob('');
  loseSource();
  forgetValues();
  useLiveStore.getState().clear();
}
