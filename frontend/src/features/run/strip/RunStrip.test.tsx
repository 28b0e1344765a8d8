import { act, screen } from '@testing-library/react';
import { beforeEach, describe, expect, it, onTestFinished } from 'vitest';
import type { Fault, Held } from '@/generated/messages';
import { useProjectStore } from '@/store/project';
import { useRunStore } from '@/store/run/store';
import { useSessionStore } from '@/store/session/store';
import {
  openProject,
  openSession,
  show,
  user,
  watchNavigation,
  type FakeExecutor,
} from '../../../../harness/testing';
import { registerRunCommands } from '../commands';
import { RunStrip } from './RunStrip';

const fault = (more: Partial<Fault>): Fault => ({
  kind: 'exception',
  message: 'division by zero',
  hint: 'Check the divisor.',
  node_id: '',
  tree_id: '',
  node_path: '',
  file: '',
  line: 0,
  traceback: '',
  ...more,
});

let executor: FakeExecutor;

beforeEach(async () => {
  onTestFinished(registerRunCommands());
  openProject({ trees: { Main: { d: { type: 'Go' } } }, texts: { 'actions/Go.py': '' } });
  executor = await openSession();
  show(<RunStrip />);
});

describe('RunStrip', () => {
  it('leaves its place to the banner of a held tree, unless there is a message', () => {
    executor.emit('held', { uid: 1, path: [1], ahead: [], statuses: [] } as unknown as Held);
    executor.emit('state-changed', { state: 'held', reason: '' });
    expect(screen.queryByTestId('run-strip')).toBeNull();
    executor.emit('fault', fault({}));
    expect(screen.getByTestId('run-strip')).toHaveTextContent('division by zero');
  });

  it('shows the state of the executor if there is no message, at the same height', () => {
    executor.emit('state-changed', { state: 'paused', reason: '' });
    expect(screen.queryByTestId('banner')).toBeNull();
    expect(screen.getByRole('region', { name: 'Messages of the run' })).not.toBeEmptyDOMElement();
  });

  it('leaves its place to the banner of a hold, also of one at a line of Python', () => {
    executor.emit('state-changed', { state: 'held', reason: '' });
    expect(useSessionStore.getState().held).toBeNull();
    expect(screen.queryByTestId('run-strip')).toBeNull();
    executor.emit('state-changed', { state: 'application_running', reason: '' });
    expect(screen.getByTestId('run-strip')).toBeInTheDocument();
  });

  it('says nothing while all is well', () => {
    executor.emit('state-changed', { state: 'paused', reason: '' });
    expect(screen.getByTestId('run-strip')).toHaveTextContent('paused');
    executor.emit('state-changed', { state: 'application_running', reason: '' });
    expect(screen.getByTestId('run-strip')).toBeEmptyDOMElement();
  });

  it('shows the most important of several messages, and all of them on demand', async () => {
    executor.emit('fault', fault({ message: 'first' }));
    executor.emit('fault', fault({ message: 'second' }));
    act(() => {
      useSessionStore.setState({ connection: 'reconnecting' });
    });
    expect(screen.getByTestId('banner')).toHaveTextContent('The connection was lost');
    const more = screen.getByRole('button', { name: 'All 3 messages' });
    expect(more).toHaveTextContent('+2');
    await user.click(more);
    const rows = screen.getAllByTestId('strip-message');
    expect(rows.map((row) => /first|second|connection/.exec(row.textContent)?.[0])).toEqual([
      'connection',
      'second',
      'first',
    ]);
  });

  it('names the line that failed, opens it, and is dismissed', async () => {
    const { openFile } = watchNavigation();
    executor.emit('fault', fault({ file: 'actions/Go.py', line: 12 }));
    const banner = screen.getByRole('alert');
    expect(banner).toHaveTextContent('actions/Go.py, line 12: division by zero Check the divisor.');
    await user.click(screen.getByRole('button', { name: 'Open Go.py:12' }));
    expect(openFile).toHaveBeenCalledWith('actions/Go.py', 12);
    await user.click(screen.getByRole('button', { name: 'Dismiss' }));
    expect(screen.queryByTestId('banner')).toBeNull();
    expect(useSessionStore.getState().faults).toEqual([]);
  });

  it('offers no file that the project does not have', () => {
    executor.emit('fault', fault({ file: 'lib/other.py', line: 3 }));
    expect(screen.getByRole('alert')).toHaveTextContent('lib/other.py, line 3:');
    expect(screen.queryByRole('button', { name: /Open/ })).toBeNull();
  });

  it('shows the block that failed', async () => {
    const { openTree } = watchNavigation();
    executor.emit('fault', fault({ node_id: 'd', tree_id: 'Main', node_path: 'Main/Go::3' }));
    expect(screen.getByRole('alert')).toHaveTextContent('Go failed:');
    await user.click(screen.getByRole('button', { name: 'Show the block' }));
    expect(openTree).toHaveBeenCalledWith('Main');
    expect(useProjectStore.getState().selection).toEqual(['d']);
  });

  it('reports why a run could not start, until it is dismissed', async () => {
    act(() => {
      useRunStore.setState({
        failure: { stage: 'starting', code: 'x', message: 'No room.', hint: 'Try later.', diagnostics: [] },
      });
    });
    expect(screen.getByRole('alert')).toHaveTextContent(
      'The session could not be started. No room. Try later.',
    );
    await user.click(screen.getByRole('button', { name: 'Dismiss' }));
    expect(useRunStore.getState().failure).toBeNull();
  });

  it('reports why the run ended', () => {
    executor.emit('state-changed', { state: 'visualization_ready', reason: 'The world was killed.' });
    expect(screen.getByRole('alert')).toHaveTextContent('The run ended: The world was killed.');
  });

  it('reports silence without an alert for each second', () => {
    act(() => {
      useSessionStore.setState({ silentS: 4 });
    });
    expect(screen.getByTestId('banner')).toHaveTextContent('The session has not answered for 4 s.');
    expect(screen.queryByRole('alert')).toBeNull();
    expect(screen.queryByRole('button', { name: 'Dismiss' })).toBeNull();
  });

  it('offers another run when the session is lost, and nothing while it reconnects', async () => {
    act(() => {
      useSessionStore.setState({ connection: 'reconnecting' });
    });
    expect(screen.getByRole('alert')).toHaveTextContent('The connection was lost; trying again.');
    expect(screen.queryByRole('button', { name: 'Dismiss' })).toBeNull();
    act(() => {
      useSessionStore.setState({ connection: 'lost', connectionMessage: 'It was ended.' });
    });
    expect(screen.getByRole('alert')).toHaveTextContent('The session has ended. It was ended.');
    expect(screen.getByRole('button', { name: 'Run' })).toBeEnabled();
    await user.click(screen.getByRole('button', { name: 'Dismiss' }));
    expect(useSessionStore.getState().connection).toBe('off');
  });
});
