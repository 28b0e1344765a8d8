import { act, screen } from '@testing-library/react';
import { beforeEach, describe, expect, it, onTestFinished, vi } from 'vitest';
import { registerCommands } from '@/commands/registry';
import { useProjectStore } from '@/store/project';
import { useRunStore } from '@/store/run/store';
import { openProject, openSession, show, user, type FakeExecutor } from '../../../harness/testing';
import { RestartOffer } from './RestartOffer';

let executor: FakeExecutor;
let count = 0;

const edit = () => {
  act(() => {
    useProjectStore.getState().addFile(`notes${(count += 1)}.md`, '');
  });
};
const runs = () => {
  act(() => {
    useRunStore.setState({ ranAt: useProjectStore.getState().changeCounter });
  });
};
const offer = () => screen.queryByRole('status');

beforeEach(async () => {
  openProject({ trees: { Main: { d: { type: 'AlwaysSuccess' } } } });
  executor = await openSession();
  show(<RestartOffer />);
  runs();
});

describe('RestartOffer', () => {
  it('appears with an edit while the program runs or is paused, and no longer', () => {
    expect(offer()).toBeNull();
    edit();
    expect(offer()).toHaveTextContent('The program changed since it was started.');
    executor.emit('state-changed', { state: 'paused', reason: '' });
    expect(offer()).not.toBeNull();
    executor.emit('state-changed', { state: 'visualization_ready', reason: '' });
    expect(offer()).toBeNull();
  });

  it('restarts the application', async () => {
    const run = vi.fn();
    onTestFinished(
      registerCommands([{ id: 'run.restart', group: 'run', labelKey: 'run:command.restart', run }]),
    );
    edit();
    await user.click(screen.getByRole('button', { name: 'Restart the application' }));
    expect(run).toHaveBeenCalledOnce();
  });

  it('stays away once declined, until the next run', async () => {
    edit();
    await user.click(screen.getByRole('button', { name: 'Later' }));
    expect(offer()).toBeNull();
    edit();
    expect(offer()).toBeNull();
    runs();
    edit();
    expect(offer()).not.toBeNull();
  });

  it('is not made while the program has errors, to a viewer, or while a run starts', () => {
    edit();
    act(() => {
      useProjectStore.getState().setChecked({
        actions: [],
        diagnostics: [{ code: 'BT0101', severity: 'error', message: 'bad' }],
      });
    });
    expect(offer()).toBeNull();
    act(() => {
      useProjectStore.getState().setChecked({
        actions: [],
        diagnostics: [{ code: 'BT0101', severity: 'warning', message: 'odd' }],
      });
    });
    expect(offer()).not.toBeNull();
    act(() => {
      useRunStore.setState({ stage: 'saving' });
    });
    expect(offer()).toBeNull();
    act(() => {
      useRunStore.setState({ stage: null });
    });
    executor.introduce({ role: 'viewer' });
    expect(offer()).toBeNull();
  });
});
