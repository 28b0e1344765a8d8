import { act } from '@testing-library/react';
import { beforeEach, describe, expect, it, onTestFinished, vi } from 'vitest';
import { setName, setPort } from '@/model/edits';
import { useProjectStore } from '@/store/project';
import { oneBlock, projectDetail, projectFile } from '@/store/testing';
import { leave } from '@/store/session/connection';
import { openSession, type FakeExecutor } from '../../../harness/testing';
import { beginProgram, setTyping, useLivePorts } from './livePorts';
import { followPorts } from './portSync';
import { useRunStore } from './store';

let executor: FakeExecutor;
const project = () => useProjectStore.getState();
const sent = () => executor.sentAs('set_port');
const type = (value: string | null, port = 'speed') => {
  project().apply('MainTree', 'port', [setPort('n1', port, value)]);
  project().seal('MainTree');
};
const hasChanged = () => project().changeCounter !== useRunStore.getState().ranAt;
const settled = () => act(() => Promise.resolve());
const node = (path: string) => ({
  uid: 1,
  parent: 0,
  type: 'Go',
  kind: 'Action',
  name: 'Go',
  path,
  node_id: 'n1',
  tree_id: 'MainTree',
});

beforeEach(async () => {
  executor = await openSession();
  project().load(projectDetail(1, [projectFile('trees/MainTree.json', 1, oneBlock('MainTree', 'Go'))]));
  project().setActiveTree('MainTree');
  useRunStore.setState({ ranAt: project().changeCounter });
  beginProgram(project().diagrams);
  executor.emit('tree', { nodes: [node('a/Go'), { ...node('b/Go'), uid: 2 }] });
  onTestFinished(followPorts());
});

describe('a changed port', () => {
  it('goes to every instance of its block at once, and no restart is offered', async () => {
    type('0.5');
    expect(sent()).toEqual([
      { node_id: 'n1', path: 'a/Go', port: 'speed', value: '0.5' },
      { node_id: 'n1', path: 'b/Go', port: 'speed', value: '0.5' },
    ]);
    await vi.waitUntil(() => !hasChanged());
  });

  it('is undone and redone in the program too', () => {
    type('0.5');
    project().undo();
    project().redo();
    expect(sent().map((data) => (data as { value: unknown }).value)).toEqual([
      '0.5',
      '0.5',
      null,
      null,
      '0.5',
      '0.5',
    ]);
  });

  it('waits until it is typed', () => {
    setTyping(true);
    type('1');
    type('1.5');
    expect(sent()).toEqual([]);
    setTyping(false);
    expect(sent()).toHaveLength(2);
  });

  it('waits for the program that is being started', () => {
    useRunStore.setState({ stage: 'launching' });
    type('0.5');
    expect(sent()).toEqual([]);
    useRunStore.setState({ stage: null });
    expect(sent()).toHaveLength(2);
  });

  it('stays here while nothing runs, or while this page only watches', () => {
    executor.emit('state-changed', { state: 'visualization_ready', reason: '' });
    type('0.5');
    executor.emit('state-changed', { state: 'application_running', reason: '' });
    expect(sent()).toHaveLength(2);
    executor.introduce({ role: 'viewer' });
    type('0.7');
    expect(sent()).toHaveLength(2);
  });

  it('that is refused is noted with what the program keeps, and a restart is offered', async () => {
    executor.refuse('set_port', 'It is read at load.', '', 'port_fixed');
    type('0.5');
    await vi.waitUntil(() => 'MainTree/n1' in useLivePorts.getState().refused);
    expect(useLivePorts.getState().refused['MainTree/n1']).toEqual({
      speed: { value: '0.5', before: null, code: 'port_fixed', message: 'It is read at load.' },
    });
    await settled();
    expect(hasChanged()).toBe(true);
  });

  it('that was refused is a plain edit once the session has ended', async () => {
    executor.refuse('set_port', 'It is read at load.', '', 'port_fixed');
    type('0.5');
    await vi.waitUntil(() => 'MainTree/n1' in useLivePorts.getState().refused);
    act(leave);
    expect(useLivePorts.getState()).toMatchObject({ refused: {}, kept: {}, program: null });
  });

  it('beside another edit still leaves a restart to offer', async () => {
    project().apply('MainTree', 'rename', [setName('n1', 'x')]);
    type('0.5');
    await settled();
    expect(sent()).toHaveLength(2);
    expect(hasChanged()).toBe(true);
  });

  it('of another user waits for the next run', () => {
    const diagram = project().diagrams['MainTree']!;
    const nodes = { n1: { ...diagram.nodes['n1']!, ports: { speed: '9' } } };
    useProjectStore.setState({ diagrams: { MainTree: { ...diagram, nodes } } });
    expect(sent()).toEqual([]);
    type('1', 'angle');
    expect(sent()).toEqual([
      { node_id: 'n1', path: 'a/Go', port: 'angle', value: '1' },
      { node_id: 'n1', path: 'b/Go', port: 'angle', value: '1' },
    ]);
  });
});
