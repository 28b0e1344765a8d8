import { afterEach, beforeEach, expect, it } from 'vitest';
import { useBreakpoints } from '@/store/debug/breakpoints';
import { useDebugMarks } from '@/store/debug/marks';
import { useProjectStore } from '@/store/project';
import { initialSession } from '@/store/session/reduce';
import { useSessionStore } from '@/store/session/store';
import { openDiagram } from '../../../../harness/canvas';
import { attached } from '../../../../harness/attached';
import { debugged, treeNode } from '../../../../harness/heldTree';
import { openSession } from '../../../../harness/testing';
import { debugCommands } from './debugCommands';

const command = (id: string) => debugCommands.find((each) => each.id === `debug.${id}`)!;
const words = (id: string) => command(id).inMenu(true);

beforeEach(() => {
  openDiagram({
    root: 'r',
    nodes: { r: { type: 'Sequence', children: ['a', 'b'] }, a: { type: 'Sleep' }, b: { type: 'Sleep' } },
  });
});
afterEach(() => {
  useBreakpoints.setState({ list: [], areOn: true });
  useDebugMarks.setState({ held: new Map(), forced: new Map() });
  useSessionStore.setState(initialSession);
});
const select = (...ids: string[]) => useProjectStore.getState().select('Main', ids);
const hold = (role: 'driver' | 'viewer') =>
  useSessionStore.setState({
    executor: 'held',
    introspection: { role } as never,
    tree: [treeNode(1, 'r'), treeNode(2, 'a'), treeNode(3, 'b')],
  });

it('set a breakpoint on all selected blocks, and remove all', () => {
  select('a');
  expect(words('breakpoint')).toBe('breakpoint');
  command('breakpoint').run();
  expect(words('breakpoint')).toBe('breakpointAway');
  select('a', 'b');
  expect(words('breakpoint')).toBe('breakpoint');
  command('breakpoint').run();
  expect(useBreakpoints.getState().list.map(({ node_id }) => node_id)).toEqual(['a', 'b']);
  command('breakpoint').run();
  expect(useBreakpoints.getState().list).toEqual([]);
});

it('force, freeze, release and continue to a block while the user controls the run', async () => {
  const executor = await openSession();
  useSessionStore.setState({ executor: 'visualization_ready' });
  select('a');
  expect(['to', 'forceSUCCESS', 'forceFAILURE', 'forceRUNNING', 'release'].map(words)).toEqual(
    Array(5).fill(null),
  );
  hold('viewer');
  expect(words('forceSUCCESS')).toBeNull();
  hold('driver');
  expect(['to', 'forceSUCCESS', 'release'].map(words)).toEqual(['stepTo', 'forceSuccess', null]);
  useSessionStore.setState({ attached: attached({ controls: true }) });
  expect(['to', 'forceSUCCESS', 'forceRUNNING'].map(words)).toEqual([null, 'forceSuccess', null]);
  useSessionStore.setState({ attached: null });
  useDebugMarks.setState({
    forced: new Map([['Main/a', { status: 'SUCCESS', once: false, after: false, alone: false }]]),
  });
  expect(words('release')).toBe('release');
  for (const id of ['to', 'forceFAILURE', 'forceRUNNING', 'release']) command(id).run();
  expect(debugged(executor)).toMatchObject([
    { command: 'step_to', data: { uid: 2 } },
    { command: 'force', data: { uid: 2, effect: 'result', status: 'FAILURE' } },
    { command: 'force', data: { uid: 2, effect: 'result', status: 'RUNNING' } },
    { command: 'release', data: { uid: 2 } },
  ]);
});
