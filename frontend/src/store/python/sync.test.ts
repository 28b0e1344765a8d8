import { beforeEach, expect, it, onTestFinished, vi } from 'vitest';
import { useBreakpoints } from '@/store/debug/breakpoints';
import { FakeDebugger, FRAMES } from '../../../harness/pythonDebugger';
import { openSession, watchNavigation, type FakeExecutor } from '../../../harness/testing';
import { changeLine, removeAllLines, toggleException, toggleLine, useLines } from './lines';
import { usePython } from './stop';
import { followPython } from './sync';

let executor: FakeExecutor;
let python: FakeDebugger;
const now = () => usePython.getState();

beforeEach(async () => {
  useLines.setState({ list: [], exceptions: [], watches: [] });
  useBreakpoints.setState({ areOn: true });
  executor = await openSession();
  python = new FakeDebugger(executor);
  onTestFinished(followPython());
});

async function connect(): Promise<void> {
  toggleLine('actions/Turn.py', 12);
  await python.answer('initialize');
  python.event('initialized');
  await python.answer('setBreakpoints', { breakpoints: [{ verified: true }] });
  await python.answer('configurationDone');
}

async function stop(reason = 'breakpoint'): Promise<void> {
  python.event('stopped', { threadId: 1, reason });
  await python.answer('stackTrace', { stackFrames: FRAMES });
}

it('asks for no debugger while nothing is set', () => {
  toggleLine('launch/talker.py', 3); // a process that the debugger does not reach
  expect([python.asked, now().phase]).toEqual([[], 'off']);
});

it('gives each program its breakpoints before its code is loaded', async () => {
  toggleLine('actions/Turn.py', 12);
  toggleException('raised');
  await python.answer('initialize');
  expect(now().phase).toBe('ready');
  for (let program = 0; program < 2; program++) {
    python.event('initialized');
    const given = await python.answer('setBreakpoints', { breakpoints: [{ verified: true }] });
    expect(given).toEqual({ source: { path: 'actions/Turn.py' }, breakpoints: [{ line: 12 }] });
    expect(await python.answer('setExceptionBreakpoints')).toEqual({ filters: ['raised'] });
    await python.answer('configurationDone');
    python.event('terminated');
    expect(now().phase).toBe('ready');
  }
});

it('gives changes alone, and says which line cannot hold', async () => {
  await connect();
  toggleLine('actions/Go.py', 3);
  await python.answer('setBreakpoints', { breakpoints: [{ verified: false, message: 'No code here.' }] });
  await vi.waitFor(() => expect(now().problems).toEqual({ 'actions/Go.py:3': 'No code here.' }));
  changeLine('actions/Go.py', 3, { condition: 'x', hits: 3, log: 'n = {n}' });
  const given = await python.answer('setBreakpoints', { breakpoints: [{ verified: true }] });
  expect(given['breakpoints']).toEqual([
    { line: 3, condition: 'x', hitCondition: '>=3', logMessage: 'n = {n}' },
  ]);
  changeLine('actions/Go.py', 3, { on: false });
  expect(await python.answer('setBreakpoints', { breakpoints: [] })).toMatchObject({ breakpoints: [] });
  expect(python.askedAs('setBreakpoints')).toHaveLength(4);
});

it('takes back a breakpoint that the debugger would move, and says that its line has no code', async () => {
  await connect();
  toggleLine('actions/Go.py', 3);
  toggleLine('actions/Go.py', 8);
  await python.answer('setBreakpoints', { breakpoints: [{ verified: true, line: 3 }] });
  const moved = [
    { verified: true, line: 3 },
    { verified: true, line: 6 },
  ];
  await python.answer('setBreakpoints', { breakpoints: moved });
  const again = await python.answer('setBreakpoints', { breakpoints: [{ verified: true, line: 3 }] });
  expect(again['breakpoints']).toEqual([{ line: 3 }]);
  await vi.waitFor(() => expect(Object.keys(now().problems)).toEqual(['actions/Go.py:8']));
  expect(now().problems['actions/Go.py:8']).toMatch(/no code/);
});

it('says at its line what the program found out about a breakpoint', async () => {
  await connect();
  const breakpoint = {
    verified: false,
    message: 'No name x.',
    line: 12,
    source: { path: 'actions/Turn.py' },
  };
  python.event('breakpoint', { reason: 'changed', breakpoint });
  expect(now().problems).toEqual({ 'actions/Turn.py:12': 'No name x.' });
  python.event('breakpoint', { reason: 'changed', breakpoint: { ...breakpoint, verified: true, line: 13 } });
  expect(now().problems).toEqual({ 'actions/Turn.py:12': 'No name x.' });
});

it('shows where a program is stopped, and brings its file to the front', async () => {
  const { showFile } = watchNavigation();
  await connect();
  await stop();
  await vi.waitFor(() => expect(now().stop?.frames).toHaveLength(2));
  expect(now().stop).toMatchObject({ thread: 1, reason: 'breakpoint', frame: 0 });
  expect(now().stop?.frames.map(({ path }) => path)).toEqual(['actions/Turn.py', '']);
  expect(showFile).toHaveBeenCalledWith('actions/Turn.py');
  python.event('continued', { threadId: 1 });
  expect(now().stop).toBeNull();
});

it('names the exception', async () => {
  await connect();
  await stop('exception');
  await python.answer('exceptionInfo', { exceptionId: 'ValueError', description: 'too many' });
  await vi.waitFor(() => expect(now().stop?.text).toBe('ValueError: too many'));
});

it('leaves a program connected without breakpoints, and debugs no other one', async () => {
  await connect();
  removeAllLines();
  expect(await python.answer('setBreakpoints', { breakpoints: [] })).toMatchObject({ breakpoints: [] });
  expect([python.askedAs('disconnect'), now().phase]).toEqual([[], 'on']);
  python.event('terminated');
  expect([python.askedAs('disconnect').length, now().phase]).toEqual([1, 'off']);
});

it('ends before a program runs when nothing is set any more', async () => {
  toggleLine('a.py', 1);
  await python.answer('initialize');
  removeAllLines();
  expect(python.asked.at(-1)?.command).toBe('disconnect');
});

it('ends with the role of the driver, and begins with it', async () => {
  await connect();
  executor.introduce({ role: 'viewer' });
  expect(now().phase).toBe('off');
  executor.introduce({ role: 'driver' });
  expect(python.askedAs('initialize')).toHaveLength(2);
});

it('says why the session refuses the debugger', async () => {
  executor.refuse('dap', 'It cannot be debugged.', 'Install debugpy.');
  toggleLine('a.py', 1);
  await vi.waitFor(() => expect(now().refusal).toBe('It cannot be debugged. Install debugpy.'));
});

it('has no breakpoints while all are switched off', async () => {
  await connect();
  useBreakpoints.setState({ areOn: false });
  expect(await python.answer('setBreakpoints', { breakpoints: [] })).toMatchObject({ breakpoints: [] });
});
