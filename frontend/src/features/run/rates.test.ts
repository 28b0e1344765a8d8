import { beforeEach, describe, expect, it, onTestFinished } from 'vitest';
import { perform, useCommandTable } from '@/commands/registry';
import { useProjectStore } from '@/store/project';
import { useRunStore } from '@/store/run/store';
import { initialSession } from '@/store/session/reduce';
import { useStatusRate } from '@/store/session/statusRate';
import { useSessionStore } from '@/store/session/store';
import { openProject } from '../../../harness/testing';
import { DEFAULT_TICK_HZ, registerRateCommands, SPEEDS, TICK_RATES } from './rates';

const commands = () => useCommandTable.getState().commands;

beforeEach(() => {
  openProject({});
  onTestFinished(registerRateCommands());
  onTestFinished(() => {
    useSessionStore.setState(initialSession, true);
    useRunStore.setState(useRunStore.getInitialState(), true);
    localStorage.clear();
  });
});

describe('commands for rates', () => {
  it('are one for each rate', () => {
    expect(TICK_RATES).toEqual([1, 2, 5, 10, 20, 50, 100]);
    expect(TICK_RATES).toContain(DEFAULT_TICK_HZ);
    expect(SPEEDS).toEqual([0.1, 0.25, 0.5, 1, 2, 4, 5, 10, 0]);
    expect(Object.keys(commands())).toHaveLength(7 + 9 + 2 + 5);
    expect(Object.values(commands()).every(({ group }) => group === 'rates')).toBe(true);
  });

  it('have labels with their values', () => {
    const label = (id: string) => [commands()[id]?.labelKey, commands()[id]?.labelValues];
    expect(label('run.tickRate.5')).toEqual(['run:command.tickRate', { hz: 5 }]);
    expect(label('run.speed.0.5')).toEqual(['run:command.speed', { speed: 0.5 }]);
    expect(label('run.speed.0')).toEqual(['run:command.fullSpeed', { speed: 0 }]);
    expect(label('run.time.exact')[0]).toBe('run:command.time.exact');
    expect(label('run.statusRate.10')).toEqual(['run:command.statusRate', { hz: 10 }]);
    expect(label('run.statusRate.0')).toEqual(['run:command.everyStatus', { hz: 0 }]);
  });

  it('set the rate', () => {
    perform('run.tickRate.5');
    perform('run.speed.0.5');
    perform('run.statusRate.10');
    perform('run.time.exact');
    expect(useProjectStore.getState().settings).toMatchObject({ tick_hz: 5, time: 'exact' });
    expect(useSessionStore.getState().speed).toBe(0.5);
    expect(useStatusRate.getState().hz).toBe(10);
  });

  it('set nothing of the run for users who may not run', () => {
    useRunStore.setState({ runBlocker: 'viewer' });
    perform('run.tickRate.5');
    perform('run.speed.0.5');
    perform('run.statusRate.2');
    perform('run.time.exact');
    expect(useProjectStore.getState().settings?.tick_hz).toBeUndefined();
    expect(useProjectStore.getState().settings?.time).toBeUndefined();
    expect(useSessionStore.getState().speed).toBe(1);
    expect(useStatusRate.getState().hz).toBe(2);
  });
});
