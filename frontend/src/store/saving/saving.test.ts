import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { api } from '@/api/client';
import { ApiError } from '@/api/errors';
import type { ChangesResult, FileChange } from '@/api/types';
import { useProjectStore } from '@/store/project';
import { projectDetail, projectFile } from '../testing';
import { saveNow, startAutosave, stopAutosave } from './autosave';
import { resolveConflict, restoreDraft } from './conflicts';
import { readDraft } from './drafts';
import { useSavingStore } from './store';

const PATH = 'actions/Go.py';

const detail = (revision = 1, content = 'first') =>
  projectDetail(revision, [projectFile(PATH, revision, content)]);

/** Returns a server that counts revisions and refuses stale bases, like the real one. */
function fakeServer(initial: string) {
  const file = { revision: 1, content: initial };
  const save = vi.spyOn(api, 'saveChanges').mockImplementation((_id, { files }) => {
    const change = files[0] as FileChange;
    if (change.base_revision !== file.revision) {
      return Promise.reject(
        new ApiError({
          title: 'Conflict',
          status: 409,
          code: 'revision_conflict',
          conflicts: [
            {
              path: PATH,
              base_revision: change.base_revision,
              theirs: { ...file },
              mine: { content: change.content ?? null },
            },
          ],
        }),
      );
    }
    file.revision += 1;
    file.content = change.content ?? '';
    const result: ChangesResult = {
      revision: file.revision,
      files: [{ path: PATH, revision: file.revision }],
      actions: [],
      diagnostics: [],
    };
    return Promise.resolve(result);
  });
  return { file, save };
}

const stateKind = () => useSavingStore.getState().state.kind;
const edit = (text: string) => useProjectStore.getState().setFileText(PATH, text);

beforeEach(() => {
  vi.useFakeTimers();
  localStorage.clear();
  useProjectStore.getState().load(detail());
  useSavingStore.setState({ state: { kind: 'saved' }, restoredFiles: 0 });
  startAutosave();
});

afterEach(() => {
  stopAutosave();
  vi.useRealTimers();
});

describe('autosave', () => {
  it('saves shortly after the last edit, once', async () => {
    const { file, save } = fakeServer('first');
    edit('a');
    edit('ab');
    expect(stateKind()).toBe('dirty');
    await vi.advanceTimersByTimeAsync(700);
    expect(save).toHaveBeenCalledTimes(1);
    expect(file.content).toBe('ab');
    expect(stateKind()).toBe('saved');
    expect(readDraft('p1')).toBeNull();
  });

  it('saves edits made during a save next, on the new base', async () => {
    const { file } = fakeServer('first');
    edit('a');
    const saving = saveNow();
    edit('b');
    await saving;
    await vi.advanceTimersByTimeAsync(700);
    expect(file).toEqual({ revision: 3, content: 'b' });
    expect(stateKind()).toBe('saved');
  });

  it.each([
    ['is unreachable', { status: 0, code: 'offline' }],
    ['was restarted and does not know the browser', { status: 403, code: 'link_required' }],
  ])('stores edits in the browser while the server %s, and saves later', async (_, problem) => {
    vi.spyOn(api, 'saveChanges').mockRejectedValue(new ApiError({ title: 'gone', ...problem }));
    edit('typed offline');
    await vi.advanceTimersByTimeAsync(700);
    expect(stateKind()).toBe('failed');
    expect(readDraft('p1')?.files[0]?.content).toBe('typed offline');

    const { file } = fakeServer('first');
    await vi.advanceTimersByTimeAsync(5000);
    expect(file.content).toBe('typed offline');
    expect(stateKind()).toBe('saved');
  });
});

describe('conflicts', () => {
  it('offer both versions and stop saving until the user has chosen', async () => {
    const { file, save } = fakeServer('first');
    file.revision = 5;
    file.content = 'theirs';
    edit('mine');
    await vi.advanceTimersByTimeAsync(700);
    expect(useSavingStore.getState().state).toMatchObject({
      kind: 'conflict',
      conflicts: [{ theirs: { content: 'theirs' }, mine: { content: 'mine' } }],
    });
    edit('mine, more');
    await vi.advanceTimersByTimeAsync(5000);
    expect(save).toHaveBeenCalledTimes(1);
    expect(useProjectStore.getState().currentText(PATH)).toBe('mine, more');
  });

  it.each([
    ['mine', 'mine'],
    ['theirs', 'theirs'],
    ['a merge', 'both'],
  ])('end with %s on top of the server’s revision', async (_name, text) => {
    const { file } = fakeServer('first');
    file.revision = 5;
    file.content = 'theirs';
    edit('mine');
    await vi.advanceTimersByTimeAsync(700);
    const { state } = useSavingStore.getState();
    if (state.kind !== 'conflict') throw new Error('no conflict');
    await resolveConflict(state.conflicts[0]!, text);
    await vi.advanceTimersByTimeAsync(700);
    expect(file.content).toBe(text);
    expect(useProjectStore.getState().currentText(PATH)).toBe(text);
    expect(stateKind()).toBe('saved');
  });
});

it('restores a file that was deleted on the server, if the user wants it', async () => {
  edit('mine');
  const save = vi.spyOn(api, 'saveChanges').mockResolvedValue({
    revision: 7,
    files: [{ path: PATH, revision: 7 }],
    actions: [],
    diagnostics: [],
  });
  const conflict = { path: PATH, base_revision: 1, theirs: null, mine: { content: 'mine' } };
  useSavingStore.setState({ state: { kind: 'conflict', conflicts: [conflict] } });
  await resolveConflict(conflict, 'mine');
  expect(save).toHaveBeenCalledWith(
    'p1',
    expect.objectContaining({ files: [{ path: PATH, base_revision: 0, content: 'mine' }] }),
  );
});

describe('drafts', () => {
  it('are restored after a crash', async () => {
    vi.spyOn(api, 'saveChanges').mockRejectedValue(
      new ApiError({ title: 'gone', status: 0, code: 'offline' }),
    );
    edit('half typed');
    stopAutosave();
    useProjectStore.getState().load(detail());
    expect(useProjectStore.getState().currentText(PATH)).toBe('first');
    restoreDraft(detail());
    expect(useProjectStore.getState().currentText(PATH)).toBe('half typed');
    expect(useSavingStore.getState().restoredFiles).toBe(1);
  });

  it('become a conflict when the file has changed meanwhile', () => {
    edit('half typed');
    stopAutosave();
    const newer = detail(4, 'somebody else');
    useProjectStore.getState().load(newer);
    restoreDraft(newer);
    expect(useSavingStore.getState().state).toMatchObject({
      kind: 'conflict',
      conflicts: [{ theirs: { revision: 4, content: 'somebody else' }, mine: { content: 'half typed' } }],
    });
  });
});
