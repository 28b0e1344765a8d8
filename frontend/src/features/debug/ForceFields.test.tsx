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
import { ForceFields } from './ForceFields';

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

it('forces and releases results, steps to the block, skips to it and runs it alone', async () => {
  const executor = await openSession();
  hold('driver');
  show(<ForceFields tree="Main" node="a" />);
  await user.selectOptions(screen.getByTestId('force-status'), 'FAILURE');
  await user.click(screen.getByRole('checkbox', { name: 'once' }));
  await user.click(screen.getByTestId('force'));
  await user.click(screen.getByTestId('step-to'));
  await user.click(screen.getByRole('button', { name: 'Skip to here' }));
  await user.click(screen.getByRole('button', { name: 'Run alone' }));
  expect(screen.queryByTestId('release')).toBeNull();
  act(() =>
    useDebugMarks.setState({
      forced: new Map([['Main/a', { status: 'FAILURE', once: true, after: false, alone: false }]]),
    }),
  );
  expect(screen.getByTestId('forced-words')).toHaveTextContent('FAILURE is forced once');
  await user.click(screen.getByTestId('release'));
  expect(debugged(executor)).toMatchObject([
    { command: 'force', data: { uid: 2, effect: 'result', status: 'FAILURE', once: true } },
    { command: 'step_to', data: { uid: 2, path: 'a' } },
    { command: 'force', data: { uid: 2, effect: 'skip_to' } },
    { command: 'force', data: { uid: 2, effect: 'alone' } },
    { command: 'release', data: { uid: 2 } },
  ]);
});
