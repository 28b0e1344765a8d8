import { expect, it } from 'vitest';
import { watchNavigation } from '../../../harness/testing';
import type { ListedProblem } from './list';
import { openProblem } from './open';

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
