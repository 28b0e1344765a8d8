import { beforeEach, describe, expect, it, vi } from 'vitest';
import type { ProjectDetail } from '@/api/types';
import { edit, setName, setPort } from '@/model/edits';
import { serializeDiagram } from '@/model/serialize';
import { createAction } from './edits/actionTemplate';
import {
  addHere,
  deleteSelection,
  duplicateSelection,
  moveIn,
  moveOut,
  reorderSelection,
} from './edits/blocks';
import { useProjectStore } from './index';
import { setNavigator } from './navigation';
import { extractSelection, inlineSelection } from './edits/subtrees';

const state = () => useProjectStore.getState();
const tree = {
  format: 'bt-studio/diagram',
  version: 1,
  id: 'MainTree',
  root: 'r',
  nodes: {
    r: { type: 'Sequence', children: ['a', 'f'] },
    a: { type: 'Turn', ports: { ang_speed: '{speed}' } },
    f: { type: 'Fallback', children: ['b'] },
    b: { type: 'Turn' },
  },
  drafts: [],
  layout: 'vertical',
};
const file = (path: string, content: string | null) => ({ path, content, revision: 3, size: 0, sha256: '' });
const project: ProjectDetail = {
  id: 'p',
  name: 'P',
  description: '',
  main_tree: 'MainTree',
  universe: '',
  revision: 3,
  created_at: '',
  updated_at: '',
  root_diagram: null,
  conditions: [],
  settings: { name: 'P', main_tree: 'MainTree' },
  files: [
    file('trees/MainTree.json', JSON.stringify(tree)),
    file('trees/Broken.json', '{'),
    file('actions/Turn.py', 'class Turn:\n    pass\n'),
    file('project.json', '{}'),
    file('assets/m.bin', null),
  ],
  actions: [{ name: 'Turn', kind: 'Action', open: true, ports: [] }],
  diagnostics: [],
};
const types = () => Object.values(state().diagrams['MainTree']!.nodes).map((node) => node.type);
const children = (id: string) => state().diagrams['MainTree']!.nodes[id]?.children;

beforeEach(() => {
  state().close();
  state().load(project);
});

describe('loading', () => {
  it('separates trees from files, and has nothing to save', () => {
    const kinds = Object.fromEntries(Object.values(state().files).map((each) => [each.path, each.kind]));
    expect(kinds).toEqual({
      'trees/MainTree.json': 'tree',
      'trees/Broken.json': 'text',
      'actions/Turn.py': 'text',
      'project.json': 'text',
      'assets/m.bin': 'binary',
    });
    expect(state().pendingChanges()).toEqual([]);
    expect(state().activeTree).toBe('MainTree');
  });
});

describe('saving', () => {
  it('sends changes with their base, and keeps later edits', () => {
    state().apply('MainTree', 'rename', [setName('a', 'left')]);
    state().setFileText('actions/Turn.py', 'one');
    const sent = state().pendingChanges();
    expect(sent.map(({ path, base_revision }) => [path, base_revision])).toEqual([
      ['trees/MainTree.json', 3],
      ['actions/Turn.py', 3],
    ]);
    state().setFileText('actions/Turn.py', 'two');
    state().applySaved(sent, {
      revision: 4,
      files: sent.map(({ path }) => ({ path, revision: 4 })),
      actions: project.actions,
      diagnostics: [],
    });
    expect(state().pendingChanges()).toEqual([{ path: 'actions/Turn.py', base_revision: 4, content: 'two' }]);
  });
  it('keeps an action that was made during a save, and drops one that the server does not have', () => {
    state().apply('MainTree', 'rename', [setName('a', 'left')]);
    const sent = state().pendingChanges();
    createAction('Wave');
    state().applySaved(sent, { revision: 4, files: [], actions: project.actions, diagnostics: [] });
    expect(state().vocabulary.specs.get('Wave')?.source).toBe('action');
    const later = state().pendingChanges();
    state().applySaved(later, { revision: 5, files: [], actions: project.actions, diagnostics: [] });
    expect(state().vocabulary.specs.has('Wave')).toBe(false);
  });
  it('keeps the known actions when the server could not check', () => {
    const before = state();
    const notChecked = { code: 'BT0009', severity: 'warning', message: 'Not checked', hint: '' } as const;
    for (const revision of [4, 5]) {
      const diagnostics = [notChecked as unknown as (typeof before.diagnostics)[number]];
      state().applySaved([], { revision, files: [], actions: [], diagnostics, checked: false });
    }
    expect(state().revision).toBe(5);
    expect(state().actions).toEqual(before.actions);
    expect(state().diagnostics.map(({ code }) => code)).toEqual(['BT0009']);
  });
  it('creates and deletes files, and drops those that the server never had', () => {
    state().addFile('actions/New.py', 'x');
    state().deleteFile('actions/New.py');
    state().deleteFile('actions/Turn.py');
    state().addTree('Sub');
    expect(state().pendingChanges()).toEqual([
      expect.objectContaining({ path: 'trees/Sub.json', base_revision: 0 }),
      { path: 'actions/Turn.py', base_revision: 3, delete: true },
    ]);
  });
  it('reads the text of a tree, and keeps an invalid one for the user to repair', () => {
    const renamed = edit(state().diagrams['MainTree']!, setName('r', 'top')).diagram;
    state().setFileText('trees/MainTree.json', serializeDiagram(renamed));
    expect(state().diagrams['MainTree']!.nodes['r']?.name).toBe('top');
    state().setFileText('trees/MainTree.json', '{ oops');
    expect(state().pendingChanges()).toEqual([
      expect.objectContaining({ path: 'trees/MainTree.json', content: '{ oops' }),
    ]);
  });
  it('continues from another revision after a conflict', () => {
    state().setFileText('actions/Turn.py', 'mine');
    state().rebase('actions/Turn.py', 9, 'theirs');
    expect(state().pendingChanges()).toEqual([
      { path: 'actions/Turn.py', base_revision: 9, content: 'mine' },
    ]);
  });
});

describe('undo', () => {
  it('is one step for one gesture, by tree, and survives a save', () => {
    for (const text of ['1', '1.', '1.5']) {
      state().apply('MainTree', 'port', [setPort('a', 'ang_speed', text)], { mergeKey: 'port a' });
    }
    expect(state().histories['MainTree']?.past).toHaveLength(1);
    const sent = state().pendingChanges();
    state().applySaved(sent, { revision: 4, files: [], actions: project.actions, diagnostics: [] });
    state().undo();
    expect(state().diagrams['MainTree']!.nodes['a']?.ports).toEqual({ ang_speed: '{speed}' });
    state().redo();
    expect(state().diagrams['MainTree']!.nodes['a']?.ports).toEqual({ ang_speed: '1.5' });
  });
  it('starts a new step when something else was selected in between', () => {
    const type = (text: string) => {
      state().apply('MainTree', 'port', [setPort('a', 'ang_speed', text)], { mergeKey: 'port a' });
    };
    type('1');
    state().select('MainTree', ['b']);
    type('2');
    expect(state().histories['MainTree']?.past).toHaveLength(2);
  });
  it('restores blocks and selection', () => {
    state().select('MainTree', ['f']);
    deleteSelection();
    expect([types(), state().selection]).toEqual([['Sequence', 'Turn'], ['a']]);
    state().undo();
    expect([children('r'), state().selection]).toEqual([['a', 'f'], ['f']]);
  });
});

describe('commands', () => {
  it('add where it fits best', () => {
    state().select('MainTree', ['a']);
    addHere({ type: 'AlwaysSuccess' });
    expect(children('r')).toEqual(['a', state().selection[0], 'f']);
  });
  it('reorder, move in and out', () => {
    state().select('MainTree', ['a']);
    reorderSelection(1);
    expect(children('r')).toEqual(['f', 'a']);
    moveIn();
    expect(children('f')).toEqual(['b', 'a']);
    moveOut();
    expect(children('r')).toEqual(['f', 'a']);
  });
  it('duplicate with the subtree', () => {
    state().select('MainTree', ['f']);
    duplicateSelection();
    expect(types().sort()).toEqual(['Fallback', 'Fallback', 'Sequence', 'Turn', 'Turn', 'Turn']);
  });
  it('extract to a new tree in one step, undone with it, and inline again', () => {
    state().select('MainTree', ['f']);
    extractSelection();
    expect(Object.keys(state().diagrams)).toEqual(['MainTree', 'FallbackTree']);
    expect(types()).toEqual(['Sequence', 'Turn', 'SubTree']);
    inlineSelection();
    expect(types().sort()).toEqual(['Fallback', 'Sequence', 'Turn', 'Turn']);
    state().undo();
    state().undo();
    expect(Object.keys(state().diagrams)).toEqual(['MainTree']);
    expect(state().pendingChanges()).toEqual([]);
  });
  it('rename an action with its file, its class and its uses', () => {
    state().renameAction('Turn', 'Spin');
    expect(state().currentText('actions/Spin.py')).toBe('class Spin:\n    pass\n');
    expect(types()).toEqual(['Sequence', 'Spin', 'Fallback', 'Spin']);
  });
  it('rename an action that other files import, and undo all of it', () => {
    state().addFile('actions/Go.py', 'from Turn import Turn\n\n\nclass Go(Turn):  # no Turn\n    pass\n');
    state().renameAction('Turn', 'Spin');
    expect(state().currentText('actions/Go.py')).toContain('from Spin import Spin');
    expect(state().currentText('actions/Go.py')).toContain('class Go(Spin):  # no Turn');
    state().undo();
    expect(types()).toEqual(['Sequence', 'Turn', 'Fallback', 'Turn']);
    expect(state().currentText('actions/Turn.py')).toBe('class Turn:\n    pass\n');
    expect(state().currentText('actions/Go.py')).toContain('from Turn import Turn');
    expect(state().files['actions/Spin.py']).toBeUndefined();
    expect(state().actions.map(({ name }) => name)).toContain('Turn');
    state().redo();
    expect(state().currentText('actions/Spin.py')).toContain('class Spin');
    expect(types()).toEqual(['Sequence', 'Spin', 'Fallback', 'Spin']);
  });
  it('tell the frame about a new name, so that tabs stay open', () => {
    const renamed = vi.fn();
    setNavigator({
      openTree: vi.fn(),
      showTree: vi.fn(() => true),
      openFile: vi.fn(),
      showFile: vi.fn(),
      openTopics: vi.fn(),
      focusField: vi.fn(),
      aimAt: vi.fn(),
      renamed,
    });
    state().renameAction('Turn', 'Spin');
    state().undo();
    state().renameTree('MainTree', 'Patrol');
    expect(renamed.mock.calls).toEqual([
      ['file', 'actions/Turn.py', 'actions/Spin.py'],
      ['file', 'actions/Spin.py', 'actions/Turn.py'],
      ['tree', 'MainTree', 'Patrol'],
    ]);
    setNavigator(null);
  });
  it('rename a tree wherever it is used', () => {
    state().select('MainTree', ['f']);
    extractSelection();
    state().renameTree('FallbackTree', 'Escape');
    expect(Object.values(state().diagrams['MainTree']!.nodes).find((node) => node.tree)?.tree).toBe('Escape');
    expect(
      state()
        .pendingChanges()
        .map((each) => each.path),
    ).toContain('trees/Escape.json');
  });
  it('create an action that can be placed at once', () => {
    createAction('Grasp', 'Condition');
    expect(state().vocabulary.specs.get('Grasp')).toMatchObject({ family: 'condition', source: 'action' });
    expect(state().currentText('actions/Grasp.py')).toContain('class Grasp(py_trees.behaviour.Behaviour)');
  });
});
