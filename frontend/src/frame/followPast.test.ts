import { expect, it, onTestFinished } from 'vitest';
import { watchTabs } from '../../harness/tabs';
import { openProject } from '../../harness/testing';
import { ofSession, useSource } from '@/store/moment/source';
import { atPresent, useMoment } from '@/store/moment/store';
import type { Moment } from '@/store/recording/types';
import { oneBlock } from '@/store/testing';
import { followFront, frontDocument, openTab, useTabs } from '@/workspace/tabs';
import { followPast } from './followPast';

const look = (isBack: boolean) => useMoment.setState({ shown: isBack ? ({} as Moment) : null });
const front = () => frontDocument(useTabs.getState().model!);

function open(kind: 'tree' | 'file') {
  const documents = watchTabs();
  openProject({ texts: { 'trees/Main.json': oneBlock('Main', 'AlwaysSuccess'), 'a.py': '' } });
  onTestFinished(() => useMoment.setState(atPresent));
  onTestFinished(followPast());
  openTab({ kind: 'tree', id: 'Main' });
  if (kind === 'file') openTab({ kind: 'file', path: 'a.py' });
  followFront(useTabs.getState().model!);
  return documents;
}

it('opens the tree as it ran in front of a tree, and gives that back in the present', () => {
  const documents = open('tree');
  look(true);
  expect(front()).toEqual({ kind: 'past' });
  look(false);
  expect(documents()).toEqual([{ kind: 'tree', id: 'Main' }]);
  expect(front()).toEqual({ kind: 'tree', id: 'Main' });
});

it('leaves another document in front', () => {
  const documents = open('file');
  look(true);
  expect(front()).toEqual({ kind: 'file', path: 'a.py' });
  expect(documents()).toContainEqual({ kind: 'past' });
  look(false);
  expect(front()).toEqual({ kind: 'file', path: 'a.py' });
});

it('opens it in a new layout, too', async () => {
  open('tree');
  look(true);
  const documents = watchTabs();
  await Promise.resolve();
  expect(documents()).toEqual([{ kind: 'past' }]);
});

it('brings a kept run that was asked for to the front of any document', () => {
  open('file');
  onTestFinished(() => useSource.setState(ofSession));
  useSource.setState({ kept: { id: 'r1', name: 'room, seed 5' } });
  look(true);
  expect(front()).toEqual({ kind: 'past' });
  look(false);
  expect(front()).toEqual({ kind: 'file', path: 'a.py' });
});
