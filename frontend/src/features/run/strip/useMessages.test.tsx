import { act, renderHook, screen } from '@testing-library/react';
import { beforeEach, describe, expect, it, onTestFinished, vi } from 'vitest';
import { registerCommands } from '@/commands/registry';
import { useProjectStore } from '@/store/project';
import { useRunStore } from '@/store/run/store';
import { openProject, openSession, show, user, type FakeExecutor } from '../../../../harness/testing';
import { RunStrip } from './RunStrip';
import { useMessages } from './useMessages';

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
const offer = () => screen.queryByTestId('restart-offer');

beforeEach(async () => {
  openProject({ trees: { Main: { d: { type: 'AlwaysSuccess' } } } });
  executor = await openSession();
  show(<RunStrip />);
  runs();
});

describe('the offer to restart', () => {
  it('appears after an edit while the program runs or is paused, and not otherwise', () => {
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
    await user.click(screen.getByRole('button', { name: 'Restart the program here' }));
    expect(run).toHaveBeenCalledOnce();
  });

  it('is not repeated after it was declined, until the next run', async () => {
    edit();
    await user.click(screen.getByRole('button', { name: 'Dismiss' }));
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
        diagnostics: [
          { code: 'BT0101', severity: 'warning', message: 'odd' },
          { code: 'TG905', severity: 'error', message: 'no leaf', file: 'tests/a.test.yaml' },
        ],
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

describe('the notice of a viewer', () => {
  const notice = () => screen.queryByTestId('looking-on');

  it('lets a viewer take over', async () => {
    const run = vi.fn();
    onTestFinished(
      registerCommands([{ id: 'run.takeOver', group: 'run', labelKey: 'run:command.takeOver', run }]),
    );
    executor.introduce({ role: 'viewer' });
    expect(notice()).toHaveTextContent('Another window has taken over this session');
    await user.click(screen.getByRole('button', { name: 'Take it back' }));
    expect(run).toHaveBeenCalledOnce();
    executor.introduce({ role: 'driver' });
    expect(notice()).toBeNull();
  });

  it('is not repeated after it was read', async () => {
    executor.introduce({ role: 'viewer' });
    await user.click(screen.getByRole('button', { name: 'Dismiss' }));
    expect(notice()).toBeNull();
  });
});

describe('useMessages', () => {
  it('lists the messages of the stores, the most important first', () => {
    const { result } = renderHook(useMessages);
    expect(result.current).toEqual([]);
    edit();
    executor.emit('state-changed', { state: 'paused', reason: 'The world was lost.' });
    expect(result.current.map(({ kind }) => kind)).toEqual(['finished', 'restart']);
  });
});
