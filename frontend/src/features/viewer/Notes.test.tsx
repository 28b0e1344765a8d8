import { act, screen, waitFor } from '@testing-library/react';
import { beforeEach, describe, expect, it, onTestFinished, vi } from 'vitest';
import { registerCommands } from '@/commands/registry';
import { atPresent, useMoment } from '@/store/moment/store';
import { openSession, show, user } from '../../../harness/testing';
import { useMoves } from './lastMove';
import { addMeasured, setMeasuring, useMeasuring } from './measuring';
import { Notes } from './Notes';

const FROM: [number, number, number, number, number, number] = [1, 2, 0, 0, 0, 0];

beforeEach(() => {
  setMeasuring(false);
  useMoves.setState({ last: null });
});

describe('the measurement', () => {
  it('asks for point after point, and is then shown', async () => {
    show(<Notes />);
    expect(screen.queryByRole('status')).toBeNull();
    act(() => setMeasuring(true));
    expect(screen.getByTestId('measured')).toHaveTextContent('Click the first point');
    act(() => addMeasured([0, 0, 0]));
    expect(screen.getByTestId('measured')).toHaveTextContent('Click the second point');
    act(() => addMeasured([3, 4, 12]));
    expect(screen.getByTestId('measured')).toHaveTextContent('13.00 m (5.00 m over the ground)');
    expect(screen.getByTestId('measured')).toHaveAttribute('data-m', '13.000');
    await user.click(screen.getByRole('button', { name: 'Stop measuring' }));
    expect(useMeasuring.getState()).toEqual({ isOn: false, points: [] });
    expect(screen.queryByTestId('measured')).toBeNull();
  });
});

describe('a moved body', () => {
  const moved = () => act(() => useMoves.setState({ last: { body: 'crate', from: FROM } }));

  it('can be put back', async () => {
    const executor = await openSession({ state: 'paused' });
    show(<Notes />);
    expect(screen.queryByTestId('moved')).toBeNull();
    moved();
    expect(screen.getByTestId('moved')).toHaveTextContent('crate was moved.');
    await user.click(screen.getByRole('button', { name: 'Put it back' }));
    expect(executor.sentAs('move_body')).toEqual([{ id: 'crate', pose: FROM }]);
    await waitFor(() => expect(screen.queryByTestId('moved')).toBeNull());
  });

  it('stays if the session refuses that', async () => {
    const executor = await openSession({ state: 'paused' });
    executor.refuse('move_body', 'No.');
    show(<Notes />);
    moved();
    await user.click(screen.getByRole('button', { name: 'Put it back' }));
    expect(screen.getByTestId('moved')).toBeInTheDocument();
  });

  it('is not put back while one looks back, but afterwards', async () => {
    onTestFinished(() => act(() => useMoment.setState(atPresent)));
    await openSession({ state: 'paused' });
    show(<Notes />);
    moved();
    act(() => useMoment.setState({ t: 1 }));
    expect(screen.queryByTestId('moved')).toBeNull();
    act(() => useMoment.setState(atPresent));
    expect(screen.getByTestId('moved')).toBeInTheDocument();
  });

  it('is forgotten with the world', async () => {
    const run = vi.fn();
    onTestFinished(registerCommands([{ id: 'run.resetWorld', group: 'run', labelKey: '', run }]));
    await openSession({ state: 'visualization_ready' });
    show(<Notes />);
    moved();
    await user.click(screen.getByRole('button', { name: 'Reset the world' }));
    expect(run).toHaveBeenCalledOnce();
    expect(screen.queryByTestId('moved')).toBeNull();
  });

  it('is forgotten once time continues', async () => {
    const executor = await openSession({ state: 'paused' });
    show(<Notes />);
    moved();
    executor.introduce({ state: 'application_running' });
    expect(screen.queryByTestId('moved')).toBeNull();
    expect(useMoves.getState().last).toBeNull();
    executor.introduce({ state: 'universe_ready' });
    moved();
    expect(screen.getByTestId('moved')).toBeInTheDocument();
  });
});
