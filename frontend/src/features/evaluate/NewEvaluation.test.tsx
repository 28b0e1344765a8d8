import { screen } from '@testing-library/react';
import { expect, it, vi } from 'vitest';
import '@/i18n/editorTexts';
import { useProjectStore } from '@/store/project';
import { openProject, show, user } from '../../../harness/testing';
import { NewEvaluation } from './NewEvaluation';

const open = (mayMake = true, names: string[] = []) => {
  openProject({ trees: { Main: { r: { type: 'Sequence' } } } });
  const made = vi.fn();
  show(<NewEvaluation names={names} mayMake={mayMake} onMade={made} onCancel={null} />);
  return made;
};

it('writes a file that can be run at once', async () => {
  const made = open();
  await user.click(screen.getByRole('button', { name: 'Make the evaluation' }));
  expect(made).toHaveBeenCalledWith('room');
  expect(useProjectStore.getState().files['evaluations/room.yaml']?.text).toContain('never: collision');
});

it('takes no name that is taken, or no name of a file', async () => {
  open(true, ['room']);
  const field = screen.getByLabelText('Name');
  await user.type(field, 'room');
  expect(screen.getByText('There is an evaluation of this name.')).toBeInTheDocument();
  await user.type(field, '/x');
  expect(screen.getByText('Use letters, digits, - and _.')).toBeInTheDocument();
  expect(screen.getByRole('button', { name: 'Make the evaluation' })).toBeDisabled();
});

it('offers viewers nothing that they may not do', () => {
  open(false);
  expect(screen.queryByRole('button')).toBeNull();
});
