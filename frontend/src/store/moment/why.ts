import { useMemo } from 'react';
import { create } from 'zustand';
import type { TreeNode } from '@/generated/messages';
import type { TickFacts } from '@/model/why/facts';
import { useProjectStore } from '@/store/project';
import { useRunStore } from '@/store/run/store';
import { useSessionStore } from '@/store/session/store';
import { useViewMode } from '@/store/viewMode';
import { useLastTick } from '@/store/session/trace/lastTick';
import type { Ticked } from '@/store/recording/types';
import { useSource } from './source';
import { useMoment } from './store';

/** Whether *Why?* is open, as it is first in the basic page; `asked` increases with each request. */
export const useWhy = create<{ readonly isOpen: boolean; readonly asked: number }>(() => ({
  isOpen: useViewMode.getState().mode === 'basic',
  asked: 0,
}));

// *Show less* leads to the basic page, too, not only a reload of it.
useViewMode.subscribe(({ mode }, before) => {
  if (mode === 'basic' && before.mode !== 'basic') useWhy.setState({ isOpen: true });
});

/** Opens the answer for the selected block, and moves the focus there. */
export const askWhy = (): void => useWhy.setState(({ asked }) => ({ isOpen: true, asked: asked + 1 }));

/** The tick that the views show: of the moment, or the last one of the session. */
export interface ShownTick {
  readonly number: number;
  readonly isHalted: boolean;
  readonly nodes: readonly TreeNode[];
  readonly facts: TickFacts;
}

const PRE_CONDITIONS = ['_failureIf', '_successIf', '_skipIf', '_while'];

/** Returns the known data of a tick; the pre-conditions are known only for the tree as it ran. */
export function tickFacts(
  nodes: readonly TreeNode[],
  { statuses, was, flashes, forced }: Ticked,
  isAsItRan: boolean,
): TickFacts {
  const after = new Map(statuses);
  const before = new Map([...after, ...was]);
  const byUid = new Map(nodes.map((node) => [node.uid, node]));
  const { diagrams } = useProjectStore.getState();
  return {
    nodes,
    before,
    changed: was.map(([uid]) => [uid, after.get(uid) ?? 'IDLE'] as const),
    flashed: flashes,
    forced: new Set(forced),
    conditions: (uid) => {
      const { tree_id = '', node_id = '' } = byUid.get(uid) ?? {};
      const block = isAsItRan ? diagrams[tree_id]?.nodes[node_id] : undefined;
      return block ? PRE_CONDITIONS.filter((name) => block.conditions?.[name] !== undefined) : null;
    },
  };
}

/** Returns the shown tick; null before the first. With `isWanted` false nothing is computed. */
export function useShownTick(isWanted: boolean): ShownTick | null {
  const shown = useMoment((state) => state.shown);
  const pastNodes = useMoment((state) => state.tree);
  const liveNodes = useSessionStore((state) => state.tree);
  const live = useLastTick((state) => (isWanted ? state : null));
  const isKept = useSource((state) => state.kept !== null);
  const ranAt = useRunStore((state) => state.ranAt);
  const isAsItRan = useProjectStore((state) => state.changeCounter === ranAt) && !isKept;
  return useMemo(() => {
    if (!isWanted) return null;
    const last = shown ? { ...shown, number: shown.tick } : live;
    const nodes = shown ? pastNodes : liveNodes;
    if (!last || last.number === 0 || nodes.length === 0) return null;
    const { number, halted } = last;
    return { number, isHalted: halted !== null, nodes, facts: tickFacts(nodes, halted ?? last, isAsItRan) };
  }, [isWanted, shown, live, pastNodes, liveNodes, isAsItRan]);
}
