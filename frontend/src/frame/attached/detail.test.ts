import { expect, it } from 'vitest';
import { attachedTree } from '../../../harness/attached';
import { attachedId, detailOf } from './detail';

it('shows the tree of a program as a project that can only be read', () => {
  const detail = detailOf(attachedTree, 'robot:1667');
  expect(detail).toMatchObject({ id: attachedId('robot:1667'), main_tree: 'Main', role: 'viewer' });
  expect(detail.files.map(({ path }) => path)).toEqual(['project.json', 'trees/Main.json']);
  expect(detail.settings).toMatchObject({ main_tree: 'Main' });
});
