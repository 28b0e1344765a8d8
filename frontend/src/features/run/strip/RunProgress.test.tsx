import { act, screen } from '@testing-library/react';
import { describe, expect, it, onTestFinished } from 'vitest';
import { closeOwnRobots, useOwnRobots } from '@/store/dialogs/ownRobots';
import { useRunStore } from '@/store/run/store';
import { openSession, show, user } from '../../../../harness/testing';
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

describe('RunProgress of a change to a running tree', () => {
  it('says what happens, also on the way back to a moment, and offers no cancel that does nothing', async () => {
    const executor = await openSession({ state: 'paused' });
    show(<RunProgress />);
    // The last step of the last run, which this page watched.
    executor.emit('progress', { rung: 'run_application', fraction: 1, message: 'The application runs' });
    stage('applying');
    expect(screen.getByRole('status')).toHaveTextContent(/^Changing the running tree$/);
    expect(screen.queryByRole('button', { name: 'Cancel' })).toBeNull();
    executor.emit('going_back', { fraction: 0.5 });
    expect(screen.getByRole('status')).toHaveTextContent('The run is made again up to the moment…');
    executor.emit('going_back', { fraction: 1 });
    expect(screen.getByRole('status')).toHaveTextContent('Changing the running tree');
    stage(null);
  });
});

describe('RunProgress of a session that waits for a place', () => {
  it('says how many go before it, and opens the list of own robots', async () => {
    const executor = await openSession({ state: 'connected' });
    onTestFinished(closeOwnRobots);
    show(<RunProgress />);
    stage('starting');
    const status = () => screen.getByRole('status');
    executor.emit('queued', { before: 2, is_own: false });
    expect(status()).toHaveTextContent(/^Waiting: 2 robots before yours/);
    executor.emit('queued', { before: 1, is_own: false });
    expect(status()).toHaveTextContent('Waiting: 1 robot before yours');
    executor.emit('queued', { before: 0, is_own: false });
    expect(status()).toHaveTextContent('Waiting: you are next');
    executor.emit('queued', { before: 3, is_own: true });
    expect(status()).toHaveTextContent('Waiting for one of your robots');
    expect(screen.getByRole('button', { name: 'Cancel' })).toBeEnabled();
    await user.click(screen.getByRole('button', { name: 'Your robots…' }));
    expect(useOwnRobots.getState().isOpen).toBe(true);
    executor.emit('queued', { before: null, is_own: false });
    expect(status()).toHaveTextContent(/^Starting the session/);
    expect(screen.queryByRole('button', { name: 'Your robots…' })).toBeNull();
  });

  it('waits no more when the executor introduces itself', async () => {
    const executor = await openSession({ state: 'connected' });
    show(<RunProgress />);
    stage('starting');
    executor.emit('queued', { before: 0, is_own: false });
    executor.introduce({});
    expect(screen.getByRole('status')).not.toHaveTextContent('Waiting');
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
