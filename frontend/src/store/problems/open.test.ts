import { expect, it } from 'vitest';
import { watchNavigation } from '../../../harness/testing';
import type { ListedProblem } from './list';
import { useProjectStore } from '@/store/project';
import { openBlock, openProblem } from './open';

it('opens the line of a file, the tree, or the topics', () => {
  const { openFile, openTree, openTopics } = watchNavigation();
  const nowhere = {
    isFault: false,
    tree: null,
    node: null,
    port: '',
    file: null,
    line: null,
    topic: null,
  } as unknown as ListedProblem;
  openProblem({ ...nowhere, file: 'actions/Go.py', line: 3 });
  openProblem({ ...nowhere, tree: 'Main' });
  openProblem({ ...nowhere, topic: '/scan', file: 'actions/Scan.py', line: 5 });
  openProblem({ ...nowhere, topic: '/scan' });
  expect(openTopics).toHaveBeenCalledOnce();
  expect(openFile).toHaveBeenNthCalledWith(1, 'actions/Go.py', 3);
  expect(openFile).toHaveBeenNthCalledWith(2, 'actions/Scan.py', 5);
  expect(openTree).toHaveBeenCalledExactlyOnceWith('Main');
});

it('leads to a block, and into the field of the port that is meant, never into the file of the tree', () => {
  const { openFile, openTree, focusField } = watchNavigation();
  openBlock({ tree: 'Main', node: 'a' });
  expect(focusField).not.toHaveBeenCalled();
  const place = { isFault: false, tree: 'Main', node: 'a', file: 'trees/Main.json', line: 7, topic: null };
  openProblem({ ...place, port: 'speed' } as ListedProblem);
  expect(useProjectStore.getState()).toMatchObject({
    selection: ['a'],
    revealed: { tree: 'Main', node: 'a' },
  });
  expect(openTree).toHaveBeenCalledTimes(2);
  expect(focusField).toHaveBeenCalledExactlyOnceWith('speed');
  expect(openFile).not.toHaveBeenCalled();
});
