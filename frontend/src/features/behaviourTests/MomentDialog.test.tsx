import { act, screen } from '@testing-library/react';
import { afterEach, beforeEach, expect, it, vi } from 'vitest';
import { closeMomentTest, openMomentTest } from '@/store/dialogs/momentTest';
import * as looking from '@/store/moment/looking';
import { openProject, show } from '../../../harness/testing';
import { MomentDialog } from './MomentDialog';

let told = vi.spyOn(looking, 'storyUntilNow');

beforeEach(() => {
  told = vi.spyOn(looking, 'storyUntilNow');
  openProject({ trees: { Main: { r: { type: 'AlwaysSuccess' } } } });
});
afterEach(() => {
  act(() => closeMomentTest());
});

function open() {
  show(<MomentDialog />);
  act(() => openMomentTest());
}

it('reads the recording only while it is open', async () => {
  told.mockResolvedValue(null);
  show(<MomentDialog />);
  expect(told).not.toHaveBeenCalled();
  act(() => openMomentTest());
  expect(await screen.findByText(/No tree was ticked until this moment/)).toBeVisible();
});

it('says that it reads, and why it cannot', async () => {
  told.mockReturnValueOnce(new Promise(() => {}));
  open();
  expect(await screen.findByText('The recording is read…')).toBeVisible();
  act(() => closeMomentTest());
  told.mockRejectedValueOnce(new Error('It is damaged.'));
  act(() => openMomentTest());
  expect(await screen.findByText('The recording cannot be read: It is damaged.')).toBeVisible();
});

it('has the form for a story', async () => {
  const node = { uid: 1, parent: 0, type: 'AlwaysSuccess', kind: 'Action', name: 'x', path: 'x' };
  told.mockResolvedValueOnce({
    nodes: [{ ...node, node_id: 'r', tree_id: 'Main' }],
    ...{ statuses: [], entries: [], isWhole: true },
    ticks: [{ number: 7, t: 0, changed: [], flashed: [[1, 'SUCCESS']], writes: [] }],
  });
  open();
  expect(await screen.findByRole('textbox', { name: 'Name' })).toHaveValue('as at tick 7');
});
