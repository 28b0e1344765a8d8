import { screen } from '@testing-library/react';
import { expect, it } from 'vitest';
import { forgetEditor, now } from '../../../harness/canvas';
import { show, user } from '../../../harness/testing';
import { EmptyTree } from './EmptyTree';

it('tells how to add the first block, and opens the box for it below the button', async () => {
  forgetEditor();
  show(<EmptyTree treeId="Main" />);
  expect(screen.getByText('This tree is empty')).toBeInTheDocument();
  expect(screen.getByText(/press Tab and type/)).toBeInTheDocument();
  const button = screen.getByRole('button', { name: 'Add the first block' });
  button.getBoundingClientRect = () => new DOMRect(300, 200, 100, 36);
  await user.click(button);
  expect(now.editor().quickAdd).toEqual({
    tree: 'Main',
    goal: { does: 'add', place: { at: 'root' } },
    x: 220,
    y: 244,
    text: '',
  });
});
