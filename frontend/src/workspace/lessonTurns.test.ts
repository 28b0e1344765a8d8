import { Actions, TabSetNode, type Model } from 'flexlayout-react';
import { afterEach, beforeEach, expect, it } from 'vitest';
import { useProjectStore } from '@/store/project';
import { setViewMode } from '@/store/viewMode';
import { openProject } from '../../harness/testing';
import { loadLayout } from './layoutModel';
import { showLesson } from './lessons';
import { actForLesson, followSelection } from './lessonTurns';
import { useTabs } from './tabs';

const trees = { Main: { r: { type: 'Sequence', children: ['a'] }, a: { type: 'Turn' } } };
let model: Model;
let end: () => void;

const front = () => {
  const set = model.getNodeById('inspector')?.getParent();
  return set instanceof TabSetNode ? set.getSelectedNode()?.getId() : undefined;
};
const select = (...ids: string[]) => useProjectStore.getState().select('Main', ids);

beforeEach(() => {
  localStorage.clear();
  setViewMode('basic');
  openProject({ trees, texts: { 'lessons/en.md': '# One' } });
  model = loadLayout('wide', true);
  useTabs.setState({ model, width: 'wide' });
  showLesson();
  end = followSelection();
});
afterEach(() => end());

it('shows the inspector for a selected block, and the lesson without one', () => {
  expect(front()).toBe('lesson');
  select('a');
  expect(front()).toBe('inspector');
  select();
  expect(front()).toBe('lesson');
});

it('leaves what the user brought to the front until another block is selected', () => {
  select('a');
  model.doAction(Actions.selectTab('lesson'));
  select('a');
  expect(front()).toBe('lesson');
  select('r');
  expect(front()).toBe('inspector');
});

it('keeps the lesson in front of what its own buttons select', () => {
  actForLesson(() => select('a'));
  expect(front()).toBe('lesson');
});

it('does not change which tabs are active', () => {
  model.doAction(Actions.setActiveTabset('editors'));
  select('a');
  expect(model.getActiveTabset()?.getId()).toBe('editors');
});

it('covers no third panel', () => {
  model.doAction(Actions.selectTab('console'));
  model.doAction(Actions.deleteTab('lesson'));
  select('a');
  select();
  expect(front()).toBe('inspector');
});
