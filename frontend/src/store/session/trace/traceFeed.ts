import type { Progress, ServerMessage, Snapshot, State, Tick, Tree } from '@/generated/messages';
import { trace } from './trace';
import { takeCachedTrace } from './overReload';

const APPLICATION: readonly State[] = ['application_running', 'paused', 'held'];

/** Whether a program runs: a tree then takes over from the last one (`apply`), and no run begins. */
let isRunning = false;

/** Passes events about nodes to the trace. */
export function feedTrace({ command, data, t }: ServerMessage): void {
  switch (command) {
    case 'tree':
      return isRunning ? trace.replace((data as Tree).nodes, t) : trace.start((data as Tree).nodes, t);
    case 'snapshot': {
      const { tree, statuses, state } = data as Snapshot;
      isRunning = APPLICATION.includes(state);
      const kept = takeCachedTrace();
      trace.start(tree?.nodes ?? [], t);
      trace.restore(kept, t);
      return trace.tick(statuses, [], t);
    }
    case 'tick': {
      const { changed, flashed } = data as Tick;
      return trace.tick(changed, flashed, t);
    }
    case 'state-changed':
      isRunning = APPLICATION.includes((data as { state: State }).state);
      if (!isRunning) trace.close();
      return;
    case 'progress':
      if ((data as Progress).rung === 'run_application') isRunning = false;
      return;
    case 'sim':
      return trace.advance(t);
  }
}
