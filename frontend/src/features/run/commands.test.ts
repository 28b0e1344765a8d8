import { beforeEach, describe, expect, it, onTestFinished } from 'vitest';
import type { State } from '@/generated/messages';
import { perform, useCommandTable } from '@/commands/registry';
import { useRunStore } from '@/store/run/store';
import { canDrive, useTeleop } from '@/store/run/teleop';
import { atPresent, useMoment } from '@/store/moment/store';
import { openProject, openSession, type FakeExecutor } from '../../../harness/testing';
import { registerRunCommands } from './commands';
import { useFollowing } from './following';

/** What acts on no world, or only ends what does. */
const OF_THE_PAST = ['run.stop', 'run.followRunning', 'run.kept', 'run.mine', 'run.end'];
let executor: FakeExecutor;
const table = () => useCommandTable.getState().commands;
const isEnabled = (id: string) => table()[`run.${id}`]?.enabled?.() ?? true;

beforeEach(async () => {
  openProject({});
  executor = await openSession();
  onTestFinished(registerRunCommands());
});

describe('commands of a run', () => {
  it.each([
    ['idle', ['run', 'end']],
    ['connected', ['run', 'end']],
    ['visualization_ready', ['run', 'restart', 'resetWorld', 'end']],
    [
      'application_running',
      ['run', 'pause', 'step', 'stop', 'step10', 'restart', 'apply', 'resetWorld', 'end'],
    ],
    ['paused', ['run', 'resume', 'step', 'stop', 'step10', 'restart', 'apply', 'resetWorld', 'end']],
  ] as const)('are available while the executor is %s', (state: State, expected) => {
    executor.emit('state-changed', { state, reason: '' });
    const asked = [
      'run',
      'pause',
      'resume',
      'step',
      'stop',
      'step10',
      'restart',
      'apply',
      'resetWorld',
      'takeOver',
      'end',
    ];
    expect(asked.filter(isEnabled)).toEqual(expected);
  });

  it('start nothing while a run starts, or if it is not allowed', () => {
    executor.emit('state-changed', { state: 'paused', reason: '' });
    useRunStore.setState({ stage: 'saving' });
    expect([isEnabled('run'), isEnabled('restart')]).toEqual([false, false]);
    useRunStore.setState({ stage: null, runBlocker: 'guest' });
    expect(isEnabled('run')).toBe(false);
  });

  it('only stop, end and take over while one looks back', () => {
    onTestFinished(() => useMoment.setState(atPresent));
    const isEnabledIn = (state: State) => {
      executor.emit('state-changed', { state, reason: '' });
      return Object.values(table())
        .filter(({ enabled }) => enabled?.() ?? true)
        .map(({ id }) => id);
    };
    useMoment.setState({ t: 1 });
    expect(isEnabledIn('application_running')).toEqual(OF_THE_PAST);
    expect(isEnabledIn('paused')).toEqual(OF_THE_PAST);
    expect(canDrive()).toBe(false);
    useMoment.setState(atPresent);
    expect(isEnabledIn('paused')).toContain('run.resume');
  });

  it('let a viewer take over', async () => {
    executor.introduce({ role: 'viewer' });
    expect(isEnabled('takeOver')).toBe(true);
    perform('run.takeOver');
    await expect.poll(() => executor.sentAs('take_over')).toEqual([{}]);
  });

  it.each([
    ['pause', 'pause', 'application_running'],
    ['resume', 'resume', 'paused'],
    ['step', 'step', 'paused'],
    ['stop', 'terminate_application', 'paused'],
    ['resetWorld', 'reset_world', 'paused'],
  ] as const)('%s sends %s', async (id, command, state) => {
    executor.emit('state-changed', { state, reason: '' });
    perform(`run.${id}`);
    await expect.poll(() => executor.sentAs(command)).toEqual([{}]);
  });

  it('step ten times', async () => {
    executor.emit('state-changed', { state: 'paused', reason: '' });
    perform('run.step10');
    await expect.poll(() => executor.sentAs('step')).toHaveLength(10);
  });

  it('wait for the steps that are under way', async () => {
    executor.emit('state-changed', { state: 'paused', reason: '' });
    const confirm = executor.takeLong('step');
    perform('run.step');
    perform('run.step');
    perform('run.resume');
    await expect.poll(() => executor.sentAs('step')).toHaveLength(1);
    expect(executor.sentAs('resume')).toEqual([]);
    confirm();
    await expect.poll(() => executor.sentAs('step')).toHaveLength(2);
    expect(executor.sentAs('resume')).toEqual([]);
    confirm();
    await expect.poll(() => executor.sentAs('resume')).toHaveLength(1);
    expect(useRunStore.getState().failure).toBeNull();
  });

  it('run on after a step that was refused', async () => {
    executor.emit('state-changed', { state: 'paused', reason: '' });
    executor.refuse('step', 'The tree has ended.');
    perform('run.step');
    perform('run.resume');
    await expect.poll(() => executor.sentAs('resume')).toHaveLength(1);
    expect(useRunStore.getState().failure?.message).toBe('The tree has ended.');
  });

  it('stop also while a step is under way', async () => {
    executor.emit('state-changed', { state: 'paused', reason: '' });
    executor.takeLong('step');
    perform('run.step');
    perform('run.stop');
    await expect.poll(() => executor.sentAs('terminate_application')).toHaveLength(1);
  });

  it('switch following and driving on and off', () => {
    const states = () => [useFollowing.getState().isOn, useTeleop.getState().isOn];
    const before = states();
    perform('run.followRunning');
    perform('run.teleop');
    expect(states()).toEqual(before.map((isOn) => !isOn));
    perform('run.followRunning');
    perform('run.teleop');
    expect(states()).toEqual(before);
  });

  it('have keys, also within text fields', () => {
    const keys = Object.values(table()).flatMap(({ id, shortcut, inTextFields }) =>
      shortcut ? [[id, shortcut, inTextFields]] : [],
    );
    expect(keys).toEqual([
      ['run.run', 'F5', true],
      ['run.pause', 'F6', true],
      ['run.resume', 'F7', true],
      ['run.step', 'F10', true],
      ['run.stop', 'Shift+F5', true],
      ['run.step10', '$mod+F10', true],
      ['run.restart', '$mod+Shift+F5', true],
      ['run.apply', '$mod+Shift+Enter', true],
    ]);
  });
});
