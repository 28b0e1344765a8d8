import { act, cleanup } from '@testing-library/react';
import { onTestFinished } from 'vitest';
import type { NodeStatus, TreeNode } from '@/generated/messages';
import { initialSession } from '@/store/session/reduce';
import { useSessionStore } from '@/store/session/store';
import { trace } from '@/store/session/trace/trace';

/** A node of a running tree; its block is `n` and its number. */
export const treeNode = (
  uid: number,
  parent: number,
  name: string,
  more: Partial<TreeNode> = {},
): TreeNode => ({
  uid,
  parent,
  name,
  type: 'Sequence',
  kind: 'Control',
  path: '',
  node_id: `n${uid}`,
  tree_id: 'Main',
  ...more,
});

type Changes = readonly (readonly [uid: number, status: NodeStatus])[];

/** Fills the trace with a run: what changes at which time, until the end. */
export function runTree(nodes: readonly TreeNode[], changes: Readonly<Record<number, Changes>>, end: number) {
  act(() => {
    trace.start(nodes, 0);
    for (const [time, changed] of Object.entries(changes)) trace.tick(changed, [], Number(time));
    trace.advance(end);
    useSessionStore.setState({ tree: [...nodes] });
  });
  onTestFinished(() => {
    cleanup();
    trace.start([], 0);
    useSessionStore.setState(initialSession, true);
  });
}
