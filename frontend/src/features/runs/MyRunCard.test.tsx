import { screen } from '@testing-library/react';
import { expect, it, vi } from 'vitest';
import type { MyRun } from '@/api/runs';
import { myRun } from '../../../harness/runs';
import { show, user } from '../../../harness/testing';
import { MyRunCard } from './MyRunCard';

const run = myRun(1, { name: 'First', result: 'failure', length_s: 5 });

function open(more: Partial<MyRun> = {}) {
  const onRemove = vi.fn().mockResolvedValue(true);
  const { container } = show(<MyRunCard run={{ ...run, ...more }} onRemove={onRemove} />);
  return { onRemove, container };
}
const menu = (name = 'First') => user.click(screen.getByRole('button', { name: `Commands on “${name}”` }));

it('is deleted after a question', async () => {
  const { onRemove } = open();
  await menu();
  await user.click(await screen.findByRole('menuitem', { name: 'Delete' }));
  await user.click(screen.getByRole('button', { name: 'Cancel' }));
  expect(onRemove).not.toHaveBeenCalled();
  await menu();
  await user.click(await screen.findByRole('menuitem', { name: 'Delete' }));
  await user.click(screen.getByRole('button', { name: 'Delete' }));
  expect(onRemove).toHaveBeenCalledOnce();
});

it('is opened in a window beside this one', async () => {
  const beside = vi.spyOn(window, 'open').mockReturnValue(null);
  open();
  await menu();
  await user.click(await screen.findByRole('menuitem', { name: 'Open in a window beside this one' }));
  expect(beside.mock.calls[0]?.[0]).toBe(`/projects/p1?run=${run.id}`);
  beside.mockRestore();
});

it('cannot be opened where its project is closed, and asks for no picture', async () => {
  const { container } = open({ may_open: false, project_name: '' });
  expect(screen.queryByRole('link')).toBeNull();
  expect(container.querySelector('img')).toBeNull();
  expect(screen.getByText(/you can no longer open its project/)).toBeInTheDocument();
  await menu();
  expect(await screen.findByRole('menuitem', { name: 'Delete' })).toBeInTheDocument();
  expect(screen.queryByRole('menuitem', { name: 'Open in a window beside this one' })).toBeNull();
});

it('names a run that was kept by itself', () => {
  open({ name: '', is_last: true });
  expect(screen.getByRole('link', { name: 'Last run' })).toBeInTheDocument();
});
