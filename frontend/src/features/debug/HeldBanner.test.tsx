import { act, screen } from '@testing-library/react';
import { afterEach, beforeEach, expect, it, onTestFinished } from 'vitest';
import type { Held, TreeNode } from '@/generated/messages';
import { initialSession } from '@/store/session/reduce';
import { useSessionStore } from '@/store/session/store';
import '@/i18n/editorTexts';
import { attached } from '../../../harness/attached';
import { show, user, watchNavigation } from '../../../harness/testing';
import { registerCommands, useCommandTable } from '@/commands/registry';
import { registerDebugCommands } from './commands';
import { HeldBanner } from './HeldBanner';

const node = (uid: number, name: string): TreeNode => ({
  uid,
  parent: uid - 1,
  type: 'Sleep',
  kind: '',
  name,
  path: name,
  node_id: `n${uid}`,
  tree_id: 'Main',
});
const held: Held = {
  uid: 2,
  path: [1, 2],
  why: 'breakpoint 1 before its tick',
  ahead: [2],
  cause: 'breakpoint',
  event: 'after',
  tick: 3,
  status: 'FAILURE',
  decided: '',
  statuses: [],
  hook: 0,
  outside: false,
};
const set = (role: 'driver' | 'viewer', more: Partial<Held> = {}) =>
  act(() =>
    useSessionStore.setState({
      executor: 'held',
      held: { ...held, ...more },
      tree: [node(1, 'root'), node(2, 'Turn')],
      introspection: { role } as never,
    }),
  );

beforeEach(() => {
  onTestFinished(registerDebugCommands());
  onTestFinished(
    registerCommands([
      { id: 'debug.to', group: 'run', labelKey: 'canvas:menu.stepTo', run: () => undefined },
    ]),
  );
});
afterEach(() => act(() => useSessionStore.setState(initialSession)));

it('says where and why the tree is held, and opens the block', async () => {
  const { openTree } = watchNavigation();
  show(<HeldBanner />);
  expect(screen.queryByTestId('held-banner')).toBeNull();
  set('driver');
  expect(screen.getByTestId('held-banner')).toHaveTextContent(
    'Held at Turn after its tick: it returned FAILURE, by a breakpoint.',
  );
  expect(screen.getByTestId('held-path')).toHaveTextContent('root › Turn');
  expect(screen.getByTestId('debug-to')).toBeDisabled();
  await user.click(screen.getByTestId('held-node'));
  expect(openTree).toHaveBeenCalledWith('Main');
  expect(screen.getAllByRole('button')).toHaveLength(8);
  expect(screen.getByTestId('tick-back')).toBeEnabled();
  expect(screen.getByTestId('debug-to')).toBeEnabled(); // the block is selected now
});

it('has no buttons for a viewer, and warns of an outside robot', () => {
  show(<HeldBanner />);
  set('viewer', { outside: true, cause: 'condition', why: 'the condition is wrong' });
  expect(screen.getAllByRole('button')).toHaveLength(1);
  expect(screen.getByTestId('held-banner')).toHaveTextContent('the condition is wrong');
  expect(screen.getByTestId('held-banner')).toHaveTextContent(
    'is wrong. The robot is not held: it keeps moving.',
  );
  expect(screen.getByTestId('held-banner')).not.toHaveTextContent('detach');
});

it('has no steps for a program that is followed: its protocol has none', () => {
  act(() => useSessionStore.setState({ attached: attached({ controls: true }) }));
  show(<HeldBanner />);
  set('driver');
  expect(screen.getByTestId('debug-continue')).toBeInTheDocument();
  expect(screen.getByTestId('held-banner')).toHaveTextContent('It waits until you continue or detach.');
  expect(screen.getAllByRole('button')).toHaveLength(2);
  const { commands } = useCommandTable.getState();
  const possible = ['continue', 'over', 'into', 'out', 'tick'].map((id) =>
    commands[`debug.${id}`]?.enabled?.(),
  );
  expect(possible).toEqual([true, false, false, false, false]);
});
