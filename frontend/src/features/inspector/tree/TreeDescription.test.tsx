import { screen } from '@testing-library/react';
import { expect, it } from 'vitest';
import { descriptionOf } from '@/model/treeAttributes';
import { useProjectStore } from '@/store/project';
import { openProject, show, user } from '../../../../harness/testing';
import { Inspector } from '../Inspector';

const main = () => useProjectStore.getState().diagrams['Main']!;

it('describes the tree while no block is selected, as one step of undo', async () => {
  openProject({ trees: { Main: { r: { type: 'Sequence' } } } });
  useProjectStore.getState().setActiveTree('Main');
  show(<Inspector />);
  const field = screen.getByRole('textbox', { name: 'Description of Main' });
  await user.type(field, 'Goes home.');
  expect(descriptionOf(main())).toBe('Goes home.');
  expect(field).toHaveValue('Goes home.');
  expect(useProjectStore.getState().vocabulary.trees.get('Main')?.description).toBe('Goes home.');
  useProjectStore.getState().undo();
  expect(descriptionOf(main())).toBe('');
});

it('leaves the place to the fields of a block', () => {
  openProject({ trees: { Main: { r: { type: 'Sequence' } } }, selected: ['r'] });
  show(<Inspector />);
  expect(screen.queryByTestId('tree-description')).toBeNull();
});
