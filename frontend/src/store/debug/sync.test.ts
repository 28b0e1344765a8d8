import { beforeEach, expect, it, onTestFinished, vi } from 'vitest';
import { openDiagram } from '../../../harness/canvas';
import { openSession, type FakeExecutor } from '../../../harness/testing';
import { changeBreakpoint, toggleBreakpoint, useBreakpoints } from './breakpoints';
import { followBreakpoints } from './sync';

const given = (executor: FakeExecutor) =>
  (executor.sentAs('set_breakpoints') as { breakpoints: { node_id: string }[]; on: boolean }[]).map(
    ({ breakpoints, on }) => [breakpoints.map(({ node_id }) => node_id).join(' '), on],
  );

beforeEach(() => {
  openDiagram({
    root: 'r',
    nodes: { r: { type: 'Sequence', children: ['a', 'b'] }, a: { type: 'Sleep' }, b: { type: 'Sleep' } },
  });
  useBreakpoints.setState({ list: [], areOn: true, refusal: '' });
});

it('gives a session its breakpoints once this page drives, and after each change', async () => {
  onTestFinished(followBreakpoints());
  toggleBreakpoint('Main', 'a');
  const executor = await openSession({ role: 'viewer' });
  toggleBreakpoint('Main', 'b');
  expect(given(executor)).toEqual([]);
  executor.introduce({ role: 'driver' });
  expect(given(executor)).toEqual([['a b', true]]);
  toggleBreakpoint('Main', 'b');
  expect(given(executor).at(-1)).toEqual(['a', true]);
});

it('gives none of blocks that do not exist, and nothing that is the same', async () => {
  const executor = await openSession();
  onTestFinished(followBreakpoints());
  toggleBreakpoint('Main', 'gone');
  expect(given(executor)).toEqual([['', true]]);
});

it('shows them as off after the session has switched them off', async () => {
  const executor = await openSession();
  onTestFinished(followBreakpoints());
  toggleBreakpoint('Main', 'a');
  executor.emit('released', { off: false });
  expect(useBreakpoints.getState().areOn).toBe(true);
  executor.emit('released', { off: true });
  expect(useBreakpoints.getState().areOn).toBe(false);
  expect(given(executor).at(-1)).toEqual(['a', false]);
});

it('keeps why the session refused them', async () => {
  const executor = await openSession();
  onTestFinished(followBreakpoints());
  executor.refuse('set_breakpoints', 'A breakpoint cannot be set.', 'Look at it.');
  toggleBreakpoint('Main', 'a');
  await vi.waitFor(() =>
    expect(useBreakpoints.getState().refusal).toBe('A breakpoint cannot be set. Look at it.'),
  );
  executor.refuse('set_breakpoints', 'It cannot be set either');
  changeBreakpoint('Main', 'a', { condition: '1 +' });
  await vi.waitFor(() => expect(useBreakpoints.getState().refusal).toBe('It cannot be set either'));
});
