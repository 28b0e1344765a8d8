import { expect, it } from 'vitest';
import { watchNavigation } from '../../../harness/testing';
import type { ListedProblem } from './list';
import { openProblem } from './open';

it('opens the line of a file, or the tree', () => {
  const { openFile, openTree } = watchNavigation();
  const nowhere = {
    isFault: false,
    tree: null,
    node: null,
    port: '',
    file: null,
    line: null,
  } as unknown as ListedProblem;
  openProblem({ ...nowhere, file: 'actions/Go.py', line: 3 });
  openProblem({ ...nowhere, tree: 'Main' });
  expect(openFile).toHaveBeenCalledExactlyOnceWith('actions/Go.py', 3);
  expect(openTree).toHaveBeenCalledExactlyOnceWith('Main');
});
