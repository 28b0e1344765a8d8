import { expect, it, onTestFinished } from 'vitest';
import { Actions, TabNode } from 'flexlayout-react';
import { useProjectStore } from '@/store/project';
import { openProject } from '../../harness/testing';
import { watchTabs } from '../../harness/tabs';
import { loadLayout } from './layoutModel';
import {
  folderOf,
  followNames,
  frontDocument,
  openPast,
  openTab,
  showPanel,
  showTree,
  useTabs,
} from './tabs';

const file = (path: string) => ({ kind: 'file', path }) as const;

it('distinguishes tabs of one name by their folders', () => {
  const open = [file('actions/tones.py'), file('nodes/tones.py'), file('tones.py'), file('notes.md')];
  expect(open.map((tab) => folderOf(tab, open))).toEqual(['actions', 'nodes', '/', null]);
});

it('shows no folder for a unique name, also beside a tree', () => {
  const tree = { kind: 'tree', id: 'Main' } as const;
  expect(folderOf(file('actions/Go.py'), [file('actions/Go.py'), tree])).toBeNull();
  expect(folderOf(tree, [tree, file('Main')])).toBeNull();
});

it('gives universes and robots the names of their documents, also after these change', () => {
  watchTabs();
  openProject({
    texts: {
      'universes/hall.yaml': 'name: Hall',
      'robots/mine/robot.yaml': 'a: 1',
      'notes/hall.yaml': 'name: x',
    },
  });
  for (const path of ['universes/hall.yaml', 'robots/mine/robot.yaml', 'notes/hall.yaml'])
    openTab(file(path));
  const names = () => {
    const found: string[] = [];
    useTabs.getState().model?.visitNodes((node) => {
      if (node instanceof TabNode) found.push(node.getName());
    });
    return found;
  };
  expect(names()).toEqual(['Hall', 'mine', 'hall.yaml']);
  const before = useTabs.getState().renames;
  useProjectStore.getState().setFileText('universes/hall.yaml', 'name: Great hall');
  useProjectStore.getState().setFileText('robots/mine/robot.yaml', 'name: Rover');
  followNames();
  expect(names()).toEqual(['Great hall', 'Rover', 'hall.yaml']);
  expect(useTabs.getState().renames).toBe(before + 1);
  followNames();
  expect(useTabs.getState().renames).toBe(before + 1);
});

it('tells universes of one name apart by their ids', () => {
  openProject({ texts: { 'universes/a.yaml': 'name: Hall', 'universes/b.yaml': 'name: Hall' } });
  const open = [file('universes/a.yaml'), file('universes/b.yaml')];
  expect(open.map((tab) => folderOf(tab, open))).toEqual(['a', 'b']);
});

it('brings a tree to the front in place of another tree, and of nothing else', () => {
  watchTabs();
  openProject({ trees: { Main: {}, Side: {} }, texts: { 'notes.md': 'x' } });
  const front = () => {
    const { model } = useTabs.getState();
    return model && frontDocument(model);
  };
  openTab({ kind: 'tree', id: 'Main' });
  expect([showTree('Main'), showTree('Side'), front()]).toEqual([true, true, { kind: 'tree', id: 'Side' }]);
  openTab(file('notes.md'));
  expect([showTree('Main'), front()]).toEqual([false, file('notes.md')]);
});

it('uncovers what is brought to the front, a kept run too, and leaves a panel large while one looks back', () => {
  localStorage.clear();
  const model = loadLayout('wide', true);
  useTabs.setState({ model, width: 'wide' });
  onTestFinished(() => useTabs.setState(useTabs.getInitialState(), true));
  const covering = () => model.getMaximizedTabset()?.getId();
  const cover = (id: string) => model.doAction(Actions.maximizeToggle(id));
  cover('output');
  showPanel('problems');
  expect(covering()).toBe('output');
  showPanel('blackboard');
  expect(covering()).toBeUndefined();
  cover('output');
  openTab(file('notes.md'));
  expect(covering()).toBeUndefined();
  cover('views');
  openPast();
  expect(covering()).toBe('views');
  model.doAction(Actions.deleteTab(model.getNodeById('editors')!.getChildren().at(-1)!.getId()));
  openPast(true);
  expect(covering()).toBeUndefined();
});
