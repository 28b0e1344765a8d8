import { act, screen } from '@testing-library/react';
import { describe, expect, it } from 'vitest';
import { useRunStore } from '@/store/run/store';
import { openSession, show } from '../../../../harness/testing';
import { fractionOf, RunProgress } from './RunProgress';

const stage = (next: ReturnType<typeof useRunStore.getState>['stage']) => {
  act(() => {
    useRunStore.setState({ stage: next });
  });
};
const percent = () => Number(screen.getByRole('progressbar').getAttribute('aria-valuenow'));

describe('RunProgress', () => {
  it('names each step, and offers to cancel once there is something to end', async () => {
    const executor = await openSession({ state: 'connected' });
    show(<RunProgress />);
    expect(screen.queryByRole('status')).toBeNull();
    stage('saving');
    expect(screen.getByRole('status')).toHaveTextContent(/^Saving the project$/);
    expect(percent()).toBe(5);
    stage('checking');
    expect(percent()).toBe(10);
    expect(screen.queryByRole('button', { name: 'Cancel' })).toBeNull();
    stage('starting');
    expect(screen.getByRole('button', { name: 'Cancel' })).toBeEnabled();
    stage('launching');
    expect(percent()).toBe(20);
    executor.emit('progress', { rung: 'launch_universe', fraction: 0.5, message: 'Loading walls' });
    expect(screen.getByRole('status')).toHaveTextContent('Starting the worldLoading walls');
    expect(percent()).toBe(50);
    stage(null);
    expect(screen.queryByRole('status')).toBeNull();
  });
});

describe('fractionOf', () => {
  it('only grows from pressing Run to running', () => {
    const steps = [
      fractionOf('saving', undefined, 0),
      fractionOf('checking', undefined, 0),
      fractionOf('starting', undefined, 0),
      fractionOf('launching', 'connect', 0.5),
      fractionOf('launching', 'launch_universe', 0.1),
      fractionOf('launching', 'launch_universe', 1),
      fractionOf('launching', 'prepare_visualization', 0.2),
      fractionOf('launching', 'run_application', 1),
    ];
    expect([...steps].sort((a, b) => a - b)).toEqual(steps);
    expect(steps.at(-1)).toBe(1);
  });
});
