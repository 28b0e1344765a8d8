import { screen } from '@testing-library/react';
import { expect, it, vi } from 'vitest';
import { show, user } from '../../../harness/testing';
import { MainTreeDialog } from './MainTreeDialog';

it('asks for one of the trees, with its file', async () => {
  const onChoose = vi.fn();
  const onClose = vi.fn();
  const choices = [
    { main: 'a.xml', tree: 'MainTree', file: 'a.xml' },
    { main: 'Patrol', tree: 'Patrol', file: 'b.xml' },
  ];
  show(
    <MainTreeDialog
      offer={{ asked: { file: new File([], 'trees.zip'), repair: false, order: 'ask' }, choices }}
      onChoose={onChoose}
      onClose={onClose}
    />,
  );
  expect(screen.getByText(/^trees.zip has several trees/)).toBeInTheDocument();
  expect(screen.getByRole('radio', { name: /MainTree/ })).toBeChecked();
  await user.click(screen.getByRole('radio', { name: /Patrol/ }));
  await user.click(screen.getByRole('button', { name: 'Import' }));
  expect(onChoose.mock.calls).toEqual([['Patrol']]);
  await user.click(screen.getByRole('button', { name: 'Do not import' }));
  expect(onClose.mock.calls).toHaveLength(1);
});
