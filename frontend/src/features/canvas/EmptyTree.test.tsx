import { act, screen } from '@testing-library/react';
import { expect, it } from 'vitest';
import { setEditor } from '@/store/project/editor';
import { forgetEditor, now } from '../../../harness/canvas';
import { show, user } from '../../../harness/testing';
import { EmptyTree } from './EmptyTree';

it('is the ghost of a block that opens the box for the first one below it', async () => {
  forgetEditor();
  show(<EmptyTree treeId="Main" />);
  expect(screen.getByText(/Click or type to search/)).toBeInTheDocument();
  const button = screen.getByRole('button', { name: 'Type or drop the first block' });
  button.getBoundingClientRect = () => new DOMRect(300, 200, 100, 36);
  await user.click(button);
  expect(now.editor().quickAdd).toEqual({
    tree: 'Main',
    goal: { does: 'add', place: { at: 'root' } },
    x: 300,
    y: 244,
    text: '',
  });
});

it('says that a block of the palette can be dropped there', () => {
  forgetEditor();
  show(<EmptyTree treeId="Main" />);
  expect(screen.getByRole('button')).not.toHaveAttribute('data-target');
  act(() => setEditor({ dragged: { type: 'Sleep' } }));
  expect(screen.getByRole('button')).toHaveAttribute('data-target');
});
