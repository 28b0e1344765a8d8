import type { ServerMessage, Snapshot, State, Tick, Tree } from '@/generated/messages';
import { history } from './trace';
import { takeKeptHistory } from './overReload';

const APPLICATION: readonly State[] = ['application_running', 'paused'];

/** Passes on to the history what concerns the nodes. */
export function feedHistory({ command, data, t }: ServerMessage): void {
  switch (command) {
    case 'tree':
      return history.start((data as Tree).nodes, t);
    case 'snapshot': {
      const { tree, statuses } = data as Snapshot;
      const kept = takeKeptHistory();
      history.start(tree?.nodes ?? [], t);
      history.restore(kept, t);
      return history.tick(statuses, [], t);
    }
    case 'tick': {
      const { changed, flashed } = data as Tick;
      return history.tick(changed, flashed, t);
    }
    case 'state-changed':
      if (!APPLICATION.includes((data as { state: State }).state)) history.close();
      return;
    case 'sim':
      return history.advance(t);
  }
}
