import { act, render, screen } from '@testing-library/react';
import userEvent from '@testing-library/user-event';
import { beforeEach, expect, it, onTestFinished, vi } from 'vitest';
import { registerCommands } from '@/commands/registry';
import { useMoment } from '@/store/moment/store';
import { useProjectStore } from '@/store/project';
import { initialSession } from '@/store/session/reduce';
import { useSessionStore } from '@/store/session/store';
import { setViewMode } from '@/store/viewMode';
import { basicPage } from '../../harness/basicPage';
import { show } from '../../harness/testing';
import { LongTick, StatusBar } from './StatusBar';

const waiting = { text: "Act 'Act' (actions/Act.py:3)", node_id: 'n1', node_path: 'Act' };
const node = { uid: 1, parent: 0, type: 'Act', kind: 'Action', name: 'Act', path: 'Act', node_id: 'n1' };

beforeEach(() => {
  useSessionStore.setState(initialSession, true);
  useMoment.setState({ t: null, shown: null });
});

it('names the action in which a tick takes long, and goes to its block', async () => {
  const reveal = vi.fn();
  useProjectStore.setState({ reveal });
  render(<LongTick />);
  expect(screen.queryByTestId('long-tick')).toBeNull();
  act(() => useSessionStore.setState({ waiting, tree: [{ ...node, tree_id: 'Main' } as never] }));
  expect(screen.getByRole('status').textContent).toBe("Waiting for Act 'Act' (actions/Act.py:3)");
  await userEvent.click(screen.getByTestId('long-tick'));
  expect(reveal).toHaveBeenCalledWith('Main', 'n1');
  act(() => useSessionStore.setState({ waiting: initialSession.waiting }));
  expect(screen.queryByTestId('long-tick')).toBeNull();
});

it('cannot go to a block that the tree does not have, and says nothing of the present in the past', () => {
  useSessionStore.setState({ waiting });
  render(<LongTick />);
  expect(screen.getByTestId('long-tick')).toHaveProperty('disabled', true);
  act(() => useMoment.setState({ t: 1 }));
  expect(screen.queryByTestId('long-tick')).toBeNull();
});

it('switches between the basic and the full page', async () => {
  const run = vi.fn();
  onTestFinished(registerCommands([{ id: 'view.mode', group: 'view', labelKey: 'x', run }]));
  basicPage();
  show(<StatusBar />);
  expect(screen.queryByRole('button', { name: 'No problems' })).toBeNull();
  await userEvent.click(screen.getByRole('button', { name: 'Show more' }));
  expect(run).toHaveBeenCalledOnce();
  act(() => setViewMode('full'));
  expect(screen.getByRole('button', { name: 'Show less' })).toBeInTheDocument();
  expect(screen.getByRole('button', { name: 'No problems' })).toBeInTheDocument();
});
