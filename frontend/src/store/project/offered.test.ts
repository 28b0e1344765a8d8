import { beforeEach, describe, expect, it } from 'vitest';
import { action, openProject } from '../../../harness/testing';
import { achieve, addHere } from './edits/blocks';
import { useProjectStore } from './index';
import { filesFor, offer, offeredSpec, useOfferedStore } from './offered';

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
