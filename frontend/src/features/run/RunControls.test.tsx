import { act, screen, waitFor } from '@testing-library/react';
import { beforeEach, describe, expect, it, onTestFinished } from 'vitest';
import { perform } from '@/commands/registry';
import type { State } from '@/generated/messages';
import { useProjectStore } from '@/store/project';
import { useRunStore } from '@/store/run/store';
import { useSessionStore } from '@/store/session/store';
import { useStatusRate } from '@/store/session/statusRate';
import {
  fakeServer,
  openProject,
  openSession,
  show,
  user,
  type FakeExecutor,
} from '../../../harness/testing';
import { basicPage } from '../../../harness/basicPage';
import { registerRunCommands } from './commands';
import { useFollowing } from './following';
import { RunControls } from './RunControls';

let executor: FakeExecutor;

async function open(state: State, role: 'driver' | 'viewer' = 'driver', account = 'user') {
  openProject({ trees: { Main: { d: { type: 'AlwaysSuccess' } } } });
  executor = await openSession({ state, role });
  fakeServer({ 'GET /me': { role: account } });
  show(<RunControls />);
}

const button = (name: string | RegExp) => screen.getByRole('button', { name });
const edit = () => {
  act(() => {
    useProjectStore.getState().addFile('notes.md', '');
  });
};

beforeEach(() => {
  onTestFinished(registerRunCommands());
});

describe('RunControls', () => {
  it.each([
    ['Pause', 'pause'],
    ['Stop (the world stays)', 'terminate_application'],
  ] as const)('%s sends %s', async (name, command) => {
    await open('application_running');
    await user.click(button(name));
    expect(executor.sentAs(command)).toEqual([{}]);
  });

  it('pauses before a step', async () => {
    await open('application_running');
    await user.click(button('Step one tick'));
    await waitFor(() => {
      expect(executor.sentAs('step')).toEqual([{}]);
    });
    expect(executor.sentAs('pause')).toEqual([{}]);
  });

  it('resumes and steps a paused run', async () => {
    await open('paused');
    expect(screen.queryByRole('button', { name: 'Pause' })).toBeNull();
    await user.click(button('Step one tick'));
    await user.click(button('Resume'));
    expect(executor.sentAs('step')).toEqual([{}]);
    expect(executor.sentAs('pause')).toEqual([]);
    expect(executor.sentAs('resume')).toEqual([{}]);
  });

  it('neither resumes nor steps a run on its way back to a moment', async () => {
    await open('paused');
    executor.emit('going_back', { fraction: 0.4 });
    for (const name of ['Step one tick', 'Resume']) expect(button(name)).toBeDisabled();
    for (const id of ['run.step', 'run.step10', 'run.resume']) perform(id);
    expect([executor.sentAs('step'), executor.sentAs('resume')]).toEqual([[], []]);
    executor.emit('going_back', { fraction: 1 });
    for (const name of ['Step one tick', 'Resume']) expect(button(name)).toBeEnabled();
  });

  it('follows the state of the executor', async () => {
    await open('application_running');
    expect(screen.getByTestId('executor-state')).toHaveTextContent(/^Running$/);
    expect(button('Run')).toBeEnabled();
    executor.emit('state-changed', { state: 'visualization_ready', reason: '' });
    executor.emit('finished', {
      status: 'SUCCESS',
      reason: 'root_finished',
      message: '',
      node_id: '',
      tree_id: '',
      node_path: '',
    });
    expect(screen.getByTestId('executor-state')).toHaveTextContent('Stopped · success');
    expect(button('Run')).toBeEnabled();
    for (const name of ['Pause', 'Step one tick', 'Stop (the world stays)'])
      expect(button(name)).toBeDisabled();
    expect(button('End the session')).toBeEnabled();
  });

  it.each([
    [{ silentS: 3 }, 'Not responding'],
    [{ isLaunching: true }, 'Starting'],
    [{ connection: 'reconnecting', silentS: 3 }, 'No connection'],
  ] as const)('shows %j as “%s”', async (change, text) => {
    await open('application_running');
    act(() => {
      useSessionStore.setState(change);
    });
    expect(screen.getByTestId('executor-state')).toHaveTextContent(text);
  });

  it('shows why a command was refused', async () => {
    await open('application_running');
    executor.refuse('pause', 'Not now.', 'Wait.');
    await user.click(button('Pause'));
    await waitFor(() => {
      expect(useRunStore.getState().failure).toMatchObject({
        code: 'command_refused',
        message: 'Not now.',
        hint: 'Wait.',
      });
    });
  });

  it('does not let a viewer run', async () => {
    await open('application_running', 'viewer');
    expect(button('Run')).toHaveAttribute('aria-disabled', 'true');
    for (const name of ['Pause', 'Step one tick', 'Stop (the world stays)', 'End the session'])
      expect(button(name)).toBeDisabled();
    expect(button(/^Ticks a second/)).toBeDisabled();
    await user.click(button('Run'));
    expect(useRunStore.getState()).toMatchObject({ stage: null, runBlocker: 'viewer' });
  });

  it('does not let a guest run', async () => {
    await open('visualization_ready', 'driver', 'guest');
    await waitFor(() => {
      expect(button('Run')).toHaveAttribute('aria-disabled', 'true');
    });
    expect(useRunStore.getState().runBlocker).toBe('guest');
  });

  it('sets the tick rate of the project and of the run', async () => {
    await open('application_running');
    await user.click(button('Ticks a second: 20 Hz'));
    await user.click(await screen.findByRole('menuitemradio', { name: '50 Hz' }));
    expect(useProjectStore.getState().settings?.tick_hz).toBe(50);
    expect(executor.sentAs('set_tick_rate')).toEqual([{ tick_hz: 50 }]);
    expect(button('Ticks a second: 50 Hz')).toBeVisible();
  });

  it('sets the speed of the simulation', async () => {
    await open('application_running');
    await user.click(button('Simulation speed: ×1'));
    await user.click(await screen.findByRole('menuitemradio', { name: '×max' }));
    expect(executor.sentAs('set_speed')).toEqual([{ speed: 0 }]);
    expect(button('Simulation speed: ×max')).toBeVisible();
  });

  it('has the other commands in a menu', async () => {
    await open('application_running');
    await user.click(button('More ways to run'));
    await user.click(await screen.findByRole('menuitem', { name: /Reset the world/ }));
    expect(executor.sentAs('reset_world')).toEqual([{}]);
    await user.click(button('More ways to run'));
    await user.click(await screen.findByRole('menuitemcheckbox', { name: /Follow/ }));
    expect(useFollowing.getState().isOn).toBe(true);
    await user.click(button('More ways to run'));
    await user.click(await screen.findByRole('menuitemradio', { name: '2 times a second' }));
    expect(useStatusRate.getState().hz).toBe(2);
  });

  it('shows that the program has changed since it was started', async () => {
    await open('application_running');
    act(() => {
      useRunStore.setState({ ranAt: useProjectStore.getState().changeCounter });
    });
    expect(button('Run')).toHaveAttribute('data-variant', 'light');
    edit();
    expect(button('Run')).toHaveAttribute('data-variant', 'filled');
  });
});

it('has Run, Pause and Stop in the basic page, a step while paused, and the rest in its menu', async () => {
  basicPage();
  await open('application_running');
  const TIME = 'Time of the next run: live';
  const names = () => screen.getAllByRole('button').map((each) => each.ariaLabel ?? each.textContent);
  expect(names()).toEqual(['Run', 'Pause', 'More ways to run', 'Stop (the world stays)', TIME]);
  await user.click(button('More ways to run'));
  expect(await screen.findByRole('menuitem', { name: /End the session/ })).toBeInTheDocument();
  await user.keyboard('{Escape}');
  act(() => useSessionStore.setState({ executor: 'paused' }));
  expect(names()).toContain('One step');
});
