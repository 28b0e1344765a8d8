import { act } from '@testing-library/react';
import { afterEach, beforeEach } from 'vitest';
import type { Held, TreeNode } from '@/generated/messages';
import { useBreakpoints } from '@/store/debug/breakpoints';
import { useDebugMarks } from '@/store/debug/marks';
import { blackboardId, initialSession } from '@/store/session/reduce';
import { useSessionStore } from '@/store/session/store';
import { openDiagram } from './canvas';
import type { FakeExecutor } from './testing';

/** A node of the running tree `Main`, whose parent is the node before it. */
export const treeNode = (uid: number, node_id: string): TreeNode => ({
  uid,
  parent: uid - 1,
  type: 'Sleep',
  kind: '',
  name: node_id,
  path: node_id,
  node_id,
  tree_id: 'Main',
});

/** A stop after the tick of the second node, by a step. */
export const held = {
  uid: 2,
  path: [1, 2],
  ahead: [],
  event: 'after',
  cause: 'step',
  status: 'FAILURE',
  decided: '',
  statuses: [[2, 'FAILURE']],
} as unknown as Held;

const entry = {
  scope: '',
  key: 'v',
  value: 0.25,
  type: 'float',
  preview: false,
  removed: false,
  changedAt: 1,
};

/** Opens a tree of a Sequence `r` with one block `a` for each test of a file. */
export function withTreeToHold(): void {
  beforeEach(() => {
    openDiagram({
      root: 'r',
      nodes: {
        r: { type: 'Sequence', children: ['a'] },
        a: { type: 'Sleep', ports: { msec: '{v}', x: '1' } },
      },
    });
  });
  afterEach(() =>
    act(() => {
      useSessionStore.setState(initialSession);
      useBreakpoints.setState({ list: [], areOn: true, refusal: '' });
      useDebugMarks.setState({ forced: new Map() });
    }),
  );
}

/** Holds the tree at `a`, as the page of a driver or viewer sees it. */
export const hold = (role: 'driver' | 'viewer') =>
  act(() =>
    useSessionStore.setState({
      executor: 'held',
      introspection: { role } as never,
      tree: [treeNode(1, 'r'), treeNode(2, 'a')],
      blackboard: { [blackboardId(entry)]: entry },
      held,
    }),
  );

/** What was sent to force, release and step. */
export const debugged = ({ sent }: FakeExecutor) =>
  sent.filter(({ command }) => ['force', 'release', 'step_to'].includes(command));
