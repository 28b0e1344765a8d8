import { act, screen } from '@testing-library/react';
import { afterEach, beforeEach, expect, it } from 'vitest';
import type { Held, TreeNode } from '@/generated/messages';
import '@/i18n/editorTexts';
import { useBreakpoints } from '@/store/debug/breakpoints';
import { useDebugMarks } from '@/store/debug/marks';
import { blackboardId, initialSession } from '@/store/session/reduce';
import { useSessionStore } from '@/store/session/store';
import { openDiagram } from '../../../harness/canvas';
import { openSession, show, user, type FakeExecutor } from '../../../harness/testing';
import { ForcedList } from './ForcedList';

const debugged = ({ sent }: FakeExecutor) =>
  sent.filter(({ command }) => ['force', 'release', 'step_to'].includes(command));

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

it('lists all that is forced', async () => {
  const executor = await openSession();
  hold('driver');
  show(<ForcedList />);
  expect(screen.queryByTestId('forced-list')).toBeNull();
  act(() =>
    useSessionStore.setState({
      forced: { nodes: [{ uid: 2, status: 'RUNNING', once: false, after: false, skips_to: 0 }], alone: 1 },
    }),
  );
  expect(screen.getAllByRole('listitem').map((item) => item.textContent)).toEqual([
    'rIt runs alone, in place of the root, until it is released.Release',
    'aIt is frozen as RUNNING, until it is released.Release',
  ]);
  await user.click(screen.getAllByRole('button', { name: 'Release' })[1]!);
  expect(debugged(executor)).toMatchObject([{ command: 'release', data: { uid: 2 } }]);
});
