import { create } from 'zustand';
import type { NodeStatus, ServerMessage, Snapshot, Tick } from '@/generated/messages';
import type { Ticked } from '@/store/recording/types';

type Pair = readonly [uid: number, status: NodeStatus];

/** The session's report of the last tick. */
export interface LastTick extends Ticked {
  /** The number of the tick; 0 before the first. */
  readonly number: number;
  /** The tick itself, if the tree was halted after it; else null. */
  readonly halted: Ticked | null;
}

const before: LastTick = { number: 0, statuses: [], was: [], flashes: [], forced: [], halted: null };

export const useLastTick = create<LastTick>(() => before);

/** Takes the events about nodes. */
export function feedLastTick({ command, data }: ServerMessage): void {
  switch (command) {
    case 'tree':
      return useLastTick.setState(before);
    case 'snapshot': {
      const { statuses } = data as Snapshot;
      return useLastTick.setState({ ...before, statuses });
    }
    case 'tick': {
      const { n, changed, flashed, forced } = data as Tick;
      const last = useLastTick.getState();
      const statuses = new Map(last.statuses);
      const was = changed.map(([uid]): Pair => [uid, statuses.get(uid) ?? 'IDLE']);
      for (const [uid, status] of changed) {
        if (status === 'IDLE') statuses.delete(uid);
        else statuses.set(uid, status);
      }
      const halted = n === last.number ? (last.halted ?? last) : null;
      useLastTick.setState({
        ...{ number: n, statuses: [...statuses], was, flashes: flashed, forced, halted },
      });
    }
  }
}
