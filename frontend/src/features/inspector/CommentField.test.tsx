import { act, screen } from '@testing-library/react';
import { beforeEach, expect, it } from 'vitest';
import { useProjectStore } from '@/store/project';
import { nodeOf, openProject, show, user } from '../../../harness/testing';
import { shownTarget } from '../../../harness/target';
import { CommentField } from './CommentField';

const Field = shownTarget('Main', CommentField);

beforeEach(() => {
  openProject({
    trees: { Main: { r: { type: 'Sequence', children: ['a'] }, a: { type: 'Sleep', comment: 'Slow.' } } },
    selected: ['a'],
  });
  show(<Field id="a" />);
});

it('writes the comment letter by letter, in one step of undo', async () => {
  const field = screen.getByRole('textbox', { name: 'Comment' });
  expect(field).toHaveValue('Slow.');
  await user.type(field, ' So');
  expect(nodeOf('Main', 'a')?.comment).toBe('Slow. So');
  expect(nodeOf('Main', 'r')?.comment).toBeUndefined();
  act(() => useProjectStore.getState().undo());
  expect(field).toHaveValue('Slow.');
});
