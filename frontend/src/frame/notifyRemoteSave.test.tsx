import { act, screen } from '@testing-library/react';
import { expect, it, vi } from 'vitest';
import * as tabs from '@/workspace/tabs';
import { show, user } from '../../harness/testing';
import { notifyRemoteSave } from './notifyRemoteSave';

it('tells what was saved, how many steps are lost, and opens the history', async () => {
  const showPanel = vi.spyOn(tabs, 'showPanel').mockReturnValue(undefined);
  show(<div />);
  notifyRemoteSave(['trees/Main.json'], { message: 'Edit', lost: 2 });
  expect(await screen.findByText(/Main\.json changed: Edit/)).toBeInTheDocument();
  expect(screen.getByText(/2 of your steps can no longer be undone/)).toBeInTheDocument();
  await user.click(screen.getByRole('button', { name: 'Open the history' }));
  expect(showPanel).toHaveBeenCalledWith('history');
});

it('says nothing of steps where none is lost, and replaces what it said before', async () => {
  show(<div />);
  notifyRemoteSave(['trees/Main.json'], { message: 'Edit', lost: 2 });
  await screen.findByText(/Main/);
  act(() => notifyRemoteSave(['actions/Go.py'], { message: 'Save', lost: 0 }));
  expect(await screen.findByText(/Go\.py changed: Save/)).toBeInTheDocument();
  expect(screen.queryByRole('button', { name: 'Open the history' })).toBeNull();
});
