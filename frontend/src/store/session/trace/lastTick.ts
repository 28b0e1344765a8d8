import { create } from 'zustand';
import type { NodeStatus, ServerMessage, Snapshot, Tick } from '@/generated/messages';

type Pair = readonly [uid: number, status: NodeStatus];

/** The session's report of the last tick. */
export interface LastTick {
  /** The number of the tick; 0 before the first. */
  readonly number: number;
  /** The nodes that are not idle after it. */
  readonly statuses: readonly Pair[];
  /** The nodes whose status it changed, with the status from before. */
  readonly was: readonly Pair[];
  /** Results within the tick that did not stay. */
  readonly flashes: readonly Pair[];
  /** Whether the tree was halted after it. */
  readonly isHalted: boolean;
}

const before: LastTick = { number: 0, statuses: [], was: [], flashes: [], isHalted: false };

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
      const { n, changed, flashed } = data as Tick;
      const last = useLastTick.getState();
      const statuses = new Map(last.statuses);
      const was = changed.map(([uid]): Pair => [uid, statuses.get(uid) ?? 'IDLE']);
      for (const [uid, status] of changed) {
        if (status === 'IDLE') statuses.delete(uid);
        else statuses.set(uid, status);
      }
      const isHalted = n === last.number;
      useLastTick.setState({ number: n, statuses: [...statuses], was, flashes: flashed, isHalted });
    }
  }
}
