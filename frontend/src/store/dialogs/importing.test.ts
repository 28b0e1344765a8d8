import { expect, it } from 'vitest';
import { closeImporting, finishImporting, openImporting, useImporting } from './importing';

it('begins with an empty form each time', () => {
  openImporting('robot', { name: 'a', files: [] });
  const { count } = useImporting.getState();
  finishImporting('a.urdf');
  closeImporting();
  expect(useImporting.getState()).toMatchObject({ isOpen: false, source: null, finished: 'a.urdf' });
  openImporting();
  expect(useImporting.getState()).toMatchObject({
    isOpen: true,
    kind: null,
    count: count + 1,
    finished: null,
  });
  closeImporting();
});
