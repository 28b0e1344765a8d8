import { beforeEach, describe, expect, it, vi } from 'vitest';
import { action, fakeServer, openProject } from '../../../harness/testing';
import { achieve, addHere } from './edits/blocks';
import { useProjectStore } from './index';
import { filesFor, followOffered, offer, offeredSpec, useOfferedStore } from './offered';

const SOURCE = 'class RecoveryNode(ControlNode):\n    pass\n';
const PATH = 'actions/RecoveryNode.py';
const store = () => useProjectStore.getState();
const types = () => Object.values(store().diagrams['Main']?.nodes ?? {}).map(({ type }) => type);

describe('offered actions', () => {
  beforeEach(() => {
    openProject({ trees: { Main: { r: { type: 'Sequence', children: [] } } }, actions: [], selected: ['r'] });
    const node = action('RecoveryNode', { kind: 'control', children: { min: 2, max: 2 } });
    offer([{ ...node, text: SOURCE }]);
    return () => offer([]);
  });

  it('brings the source with the block, and undo takes both away', () => {
    addHere({ type: 'RecoveryNode' });
    expect(types()).toEqual(['Sequence', 'RecoveryNode']);
    expect(store().currentText(PATH)).toBe(SOURCE);
    store().undo();
    expect(types()).toEqual(['Sequence']);
    expect(store().currentText(PATH)).toBeNull();
    store().redo();
    expect(store().currentText(PATH)).toBe(SOURCE);
  });

  it('brings it once, and never over a file of the project', () => {
    addHere({ type: 'RecoveryNode' });
    store().setFileText(PATH, `${SOURCE}# mine\n`);
    expect(filesFor({ type: 'RecoveryNode' })).toEqual({});
    addHere({ type: 'RecoveryNode' });
    expect(store().currentText(PATH)).toBe(`${SOURCE}# mine\n`);
  });

  it('brings it with a wrap and with another type of a block', () => {
    achieve({ does: 'wrap', nodes: ['r'] }, { type: 'RecoveryNode' });
    expect(store().currentText(PATH)).toBe(SOURCE);
    store().undo();
    achieve({ does: 'morph', node: 'r' }, { type: 'RecoveryNode' });
    expect(types()).toEqual(['RecoveryNode']);
    expect(store().currentText(PATH)).toBe(SOURCE);
  });

  it('knows the declaration before the project has the file', () => {
    expect(offeredSpec('RecoveryNode')).toMatchObject({ family: 'control', maxChildren: 2 });
    expect(offeredSpec('Forward')).toBeUndefined();
    expect(useOfferedStore.getState().specs.map(({ source }) => source)).toEqual(['offered']);
  });
});

it("offers what the project's distribution has, also after a change of it", async () => {
  openProject({ trees: { Main: { r: { type: 'Sequence' } } } });
  const node = (name: string) => [{ ...action(`Node_${name}`), text: '' }];
  const { requests } = fakeServer({
    'GET /catalog/actions?ros_distro=jazzy': node('jazzy'),
    'GET /catalog/actions?ros_distro=humble': node('humble'),
  });
  const offered = () => useOfferedStore.getState().specs.map(({ type }) => type);
  const stop = followOffered();
  await vi.waitFor(() => expect(offered()).toEqual(['Node_jazzy']));
  store().setSettings({ ros_distro: 'humble' });
  await vi.waitFor(() => expect(offered()).toEqual(['Node_humble']));
  store().setSettings({ ros_distro: 'jazzy' });
  await vi.waitFor(() => expect(offered()).toEqual(['Node_jazzy']));
  expect(requests).toHaveLength(2); // each is asked for once
  stop();
  store().setSettings({ ros_distro: 'humble' });
  expect(offered()).toEqual(['Node_jazzy']);
  offer([]);
});
