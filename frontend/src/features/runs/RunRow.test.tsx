import { Modal } from '@mantine/core';
import { screen } from '@testing-library/react';
import { expect, it, vi } from 'vitest';
import type { StoredRun } from '@/api/runs';
import { storedRun } from '../../../harness/runs';
import { show, user } from '../../../harness/testing';
import { RunRow } from './RunRow';

const run = storedRun({ name: 'First', result: 'success', is_pinned: true, is_shared: true });

function open(more: Partial<StoredRun> = {}) {
  const onChange = vi.fn().mockResolvedValue(true);
  const onRemove = vi.fn().mockResolvedValue(true);
  const onOpen = vi.fn();
  const calls = { onOpen, onChange, onRemove };
  show(<RunRow projectId="p1" run={{ ...run, ...more }} {...calls} />);
  return calls;
}
const choose = async (name: string) => {
  await user.click(screen.getByRole('button', { name: 'Commands on “First”' }));
  await user.click(await screen.findByRole('menuitem', { name }));
};

it('is unpinned, and no more shared, without a question', async () => {
  const { onChange } = open();
  await choose('Unpin');
  await choose('Stop sharing');
  expect(onChange.mock.calls).toEqual([[{ is_pinned: false }], [{ is_shared: false }]]);
});

it('keeps its name with Escape, and with an empty one', async () => {
  const { onChange } = open();
  for (const keys of ['Other{Escape}', '{Enter}']) {
    await choose('Rename');
    await user.clear(await screen.findByRole('textbox', { name: 'Name' }));
    await user.keyboard(keys);
    expect(screen.queryByRole('textbox')).toBeNull();
  }
  expect(onChange).not.toHaveBeenCalled();
});

it('leaves the dialogue around it open when Escape leaves its name', async () => {
  const onClose = vi.fn();
  const calls = { onOpen: vi.fn(), onChange: vi.fn(), onRemove: vi.fn() };
  show(
    <Modal opened onClose={onClose}>
      <RunRow projectId="p1" run={run} {...calls} />
    </Modal>,
  );
  await choose('Rename');
  await user.click(await screen.findByRole('textbox', { name: 'Name' }));
  await user.keyboard('{Escape}');
  expect(screen.queryByRole('textbox')).toBeNull();
  expect(onClose).not.toHaveBeenCalled();
});

it('is not shared by those who may not', async () => {
  open({ is_shared: false, may_share: false });
  await user.click(screen.getByRole('button', { name: 'Commands on “First”' }));
  expect(await screen.findByRole('menuitem', { name: 'Rename' })).toBeInTheDocument();
  expect(screen.queryByRole('menuitem', { name: 'Share with the project…' })).toBeNull();
});

it('is opened by its name', async () => {
  const { onOpen } = open();
  await user.click(screen.getByRole('button', { name: 'First' }));
  expect(onOpen).toHaveBeenCalledOnce();
});

it('is named and kept with one press, if it is the last run', async () => {
  const { onChange } = open({ name: '', is_last: true });
  expect(screen.getByRole('button', { name: 'Last run' })).toBeInTheDocument();
  await user.click(screen.getByRole('button', { name: 'Keep' }));
  expect(onChange).toHaveBeenCalledWith({ is_last: false });
});
