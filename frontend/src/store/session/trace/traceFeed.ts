import type { ServerMessage, Snapshot, State, Tick, Tree } from '@/generated/messages';
import { trace } from './trace';
import { takeCachedTrace } from './overReload';

const APPLICATION: readonly State[] = ['application_running', 'paused', 'held'];

/** Passes events about nodes to the trace. */
export function feedTrace({ command, data, t }: ServerMessage): void {
  switch (command) {
    case 'tree':
      return trace.start((data as Tree).nodes, t);
    case 'snapshot': {
      const { tree, statuses } = data as Snapshot;
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
      if (!APPLICATION.includes((data as { state: State }).state)) trace.close();
      return;
    case 'sim':
      return trace.advance(t);
  }
}
