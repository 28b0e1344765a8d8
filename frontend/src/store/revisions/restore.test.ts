import { beforeEach, expect, it, vi } from 'vitest';
import { api } from '@/api/client';
import { revisions } from '@/api/revisions';
import type { ProjectDetail } from '@/api/types';
import { useProjectStore } from '@/store/project';
import { treePath } from '@/store/project/state';
import { catchUp } from '@/store/saving/live';
import { oneBlock, projectDetail, projectFile } from '../testing';
import { restoreRevision } from './restore';

const ACTION = 'actions/Go.py';

const detail = (revision: number, type: string, source: string) =>
  projectDetail(
    revision,
    [projectFile(treePath('Main'), revision, oneBlock('Main', type)), projectFile(ACTION, revision, source)],
    'Main',
  );

const store = () => useProjectStore.getState();
const type = () => store().diagrams['Main']?.nodes['n1']?.type;

beforeEach(() => {
  localStorage.clear();
  store().load(detail(3, 'New', 'new'));
});

it('restores files as a new revision, and makes the change of a tree undoable', async () => {
  const ask = vi.spyOn(revisions, 'restore').mockResolvedValue(detail(4, 'Old', 'old'));
  expect(await restoreRevision(1, [])).toEqual({ previous: 3, isChanged: true });
  expect(ask).toHaveBeenCalledWith('p1', 1, []);
  expect([type(), store().currentText(ACTION), store().revision]).toEqual(['Old', 'old', 4]);
  expect(store().pendingChanges()).toEqual([]);
  store().undo();
  expect(type()).toBe('New');
  expect(store().pendingChanges()).toMatchObject([{ path: treePath('Main'), base_revision: 4 }]);
});

it('saves pending edits first, and does nothing if that fails', async () => {
  vi.spyOn(api, 'saveChanges').mockRejectedValue(new Error('no room'));
  const ask = vi.spyOn(revisions, 'restore');
  store().setFileText(ACTION, 'half typed');
  await expect(restoreRevision(1, [])).rejects.toThrow('no room');
  expect(ask).not.toHaveBeenCalled();
  expect(store().currentText(ACTION)).toBe('half typed');
});

it('keeps the undo of a tree even if the notice of the revision comes before the answer', async () => {
  let answer: (detail: ProjectDetail) => void = () => undefined;
  vi.spyOn(revisions, 'restore').mockReturnValue(new Promise((resolve) => (answer = resolve)));
  const fetched = vi.spyOn(api, 'getProject');
  const restoring = restoreRevision(1, []);
  await vi.waitFor(() => expect(revisions.restore).toHaveBeenCalled());
  const notice = { type: 'revision', revision: 4, author: 'local', message: '' } as const;
  const told = catchUp('p1', notice, () => undefined);
  answer(detail(4, 'Old', 'old'));
  await Promise.all([restoring, told]);
  expect(fetched).not.toHaveBeenCalled();
  expect(store().histories['Main']?.past).toHaveLength(1);
});
