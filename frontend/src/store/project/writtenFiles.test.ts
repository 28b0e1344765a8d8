import { beforeEach, describe, expect, it } from 'vitest';
import { addNode } from '@/model/edits';
import { parseDiagram, serializeDiagram } from '@/model/serialize';
import { oneBlock } from '@/store/testing';
import { openProject } from '../../../harness/testing';
import { useProjectStore } from '.';
import { withFilesOfStep, withTexts } from './writtenFiles';

const store = () => useProjectStore.getState();
const tree = (id: string, type: string) => serializeDiagram(parseDiagram(oneBlock(id, type)));
const calls = addNode('n9', { type: 'SubTree', tree: 'Dock' }, { at: 'child', parent: 'r', index: 0 });

const insert = () =>
  store().apply('Main', 'paste', [calls], {
    files: {
      'trees/Dock.json': tree('Dock', 'Creep'),
      'actions/Creep.py': 'class Creep(Behaviour):\n    NODE_KIND = "Condition"\n',
      'actions/Turn.py': 'class Turn: theirs',
    },
  });

beforeEach(() => {
  openProject({
    trees: { Main: { r: { type: 'Sequence' } } },
    texts: { 'actions/Turn.py': 'class Turn: mine' },
  });
  store().setActiveTree('Main');
});

describe('a step that writes files', () => {
  it('is undone and done again with its trees and files', () => {
    insert();
    const after = store().pendingChanges();
    expect(after.map(({ path }) => path).sort()).toEqual([
      'actions/Creep.py',
      'actions/Turn.py',
      'trees/Dock.json',
      'trees/Main.json',
    ]);
    expect(store().vocabulary.specs.get('Creep')?.family).toBe('condition');
    store().undo();
    expect(store().pendingChanges()).toEqual([]);
    expect(Object.keys(store().diagrams)).toEqual(['Main']);
    expect(store().currentText('actions/Turn.py')).toBe('class Turn: mine');
    expect(store().vocabulary.specs.has('Creep')).toBe(false);
    store().redo();
    expect(store().pendingChanges()).toEqual(after);
    expect(store().vocabulary.specs.has('Creep')).toBe(true);
  });

  it('leaves files that were edited since', () => {
    insert();
    store().setFileText('actions/Creep.py', 'class Creep: edited');
    store().setFileText('trees/Dock.json', tree('Dock', 'Sleep'));
    store().undo('Main');
    expect(store().diagrams['Main']?.nodes['r']?.children ?? []).toEqual([]);
    expect(store().currentText('actions/Creep.py')).toBe('class Creep: edited');
    expect(store().diagrams['Dock']?.nodes['n1']?.type).toBe('Sleep');
    expect(store().currentText('actions/Turn.py')).toBe('class Turn: mine');
  });

  it('takes saved files away from the server too', () => {
    insert();
    const sent = store().pendingChanges();
    store().applySaved(sent, {
      revision: 2,
      files: sent.map(({ path }) => ({ path, revision: 2 })),
      checked: false,
      actions: [],
      diagnostics: [],
    } as never);
    store().undo();
    expect(store().pendingChanges()).toContainEqual({
      path: 'actions/Creep.py',
      base_revision: 2,
      delete: true,
    });
    expect(store().pendingChanges()).toContainEqual({
      path: 'trees/Dock.json',
      base_revision: 2,
      delete: true,
    });
    store().redo();
    expect(
      store()
        .pendingChanges()
        .filter((change) => change.delete),
    ).toEqual([]);
    expect(store().removed).toEqual({});
  });

  it('drops the history of a tree that it replaces, which fits the former one only', () => {
    store().addFile('trees/Dock.json', tree('Dock', 'Wait'));
    store().setFileText('trees/Dock.json', tree('Dock', 'Sleep'));
    insert();
    store().undo('Dock');
    expect(store().diagrams['Dock']?.nodes['n1']?.type).toBe('Creep');
    store().undo('Main');
    expect(store().diagrams['Dock']?.nodes['n1']?.type).toBe('Sleep');
  });
});

it('writes texts and takes files away; a broken tree stays a text', () => {
  const before = store();
  const after = withTexts(before, { 'trees/Main.json': '{', 'actions/Turn.py': null });
  expect(after.files['trees/Main.json']?.text).toBe('{');
  expect(after.diagrams).toEqual({});
  expect(after.removed).toEqual({ 'actions/Turn.py': 1 });
  const entry = { label: '', mergeKey: null, patches: [], inverse: [], before: [], after: [] };
  expect(withFilesOfStep(before, entry, 'undo')).toBe(before);
});
