import { act, screen } from '@testing-library/react';
import { afterEach, beforeEach, expect, it } from 'vitest';
import type { Held, TreeNode } from '@/generated/messages';
import '@/i18n/editorTexts';
import { useBreakpoints } from '@/store/debug/breakpoints';
import { useDebugMarks } from '@/store/debug/marks';
import { blackboardId, initialSession } from '@/store/session/reduce';
import { useSessionStore } from '@/store/session/store';
import { openDiagram } from '../../../harness/canvas';
import { show } from '../../../harness/testing';
import { StopValues } from './StopValues';

const node = (uid: number, node_id: string): TreeNode => ({
  uid,
  parent: uid - 1,
  type: 'Sleep',
  kind: '',
  name: node_id,
  path: node_id,
  node_id,
  tree_id: 'Main',
});
const held = {
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

beforeEach(() => {
  openDiagram({
    root: 'r',
    nodes: { r: { type: 'Sequence', children: ['a'] }, a: { type: 'Sleep', ports: { msec: '{v}', x: '1' } } },
  });
});
afterEach(() =>
  act(() => {
    useSessionStore.setState(initialSession);
    useBreakpoints.setState({ list: [], areOn: true, refusal: '' });
    useDebugMarks.setState({ forced: new Map() });
  }),
);
const hold = (role: 'driver' | 'viewer') =>
  act(() =>
    useSessionStore.setState({
      executor: 'held',
      introspection: { role } as never,
      tree: [node(1, 'r'), node(2, 'a')],
      blackboard: { [blackboardId(entry)]: entry },
      held,
    }),
  );

it('shows the ports and the status of the block at the stop', () => {
  hold('viewer');
  show(<StopValues tree="Main" node="a" />);
  expect(screen.getByTestId('stop-status')).toHaveTextContent(
    'The tree is held here, after its tick: it returned FAILURE, since a step ended.',
  );
  expect(screen.getByTestId('stop-msec')).toHaveTextContent('0.25 {v}');
  expect(screen.getByTestId('stop-x')).toHaveTextContent('1');
});
