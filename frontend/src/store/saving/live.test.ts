import { beforeEach, describe, expect, it, vi } from 'vitest';
import { api } from '@/api/client';
import type { ProjectFile } from '@/api/types';
import { setComment, setName } from '@/model/edits';
import { useProjectStore } from '@/store/project';
import { oneBlock, projectDetail, projectFile } from '../testing';
import { catchUp } from './live';

const detail = (revision: number, files: ProjectFile[]) => projectDetail(revision, files, 'Main');

const saved = (fields: object): string =>
  JSON.stringify({
    ...(JSON.parse(oneBlock('Main', 'Go')) as object),
    nodes: { n1: { type: 'Go', ...fields } },
  });

const store = () => useProjectStore.getState();
const notice = (revision: number) =>
  ({ type: 'revision', revision, author: 'ana', message: 'Edit' }) as const;
const onTaken = vi.fn();

function serverHas(revision: number, files: ProjectFile[]): void {
  vi.spyOn(api, 'getProject').mockResolvedValue(detail(revision, files));
}

beforeEach(() => {
  onTaken.mockReset();
  store().load(
    detail(1, [
      projectFile('actions/Go.py', 1, 'go'),
      projectFile('actions/Turn.py', 1, 'turn'),
      projectFile('trees/Main.json', 1, oneBlock('Main', 'Go')),
    ]),
  );
});

describe('a revision that was made elsewhere', () => {
  it('is applied, with files that are new, changed and deleted', async () => {
    serverHas(2, [
      projectFile('actions/Go.py', 2, 'go on'),
      projectFile('actions/New.py', 2, 'new'),
      projectFile('trees/Main.json', 2, oneBlock('Main', 'Turn')),
    ]);
    await catchUp('p1', notice(2), onTaken);
    expect(store().currentText('actions/Go.py')).toBe('go on');
    expect(store().currentText('actions/New.py')).toBe('new');
    expect(store().currentText('actions/Turn.py')).toBeNull();
    expect(store().diagrams['Main']?.nodes['n1']?.type).toBe('Turn');
    expect(store().pendingChanges()).toEqual([]);
    expect(store().revision).toBe(2);
    expect(onTaken.mock.calls[0]?.[0]).toHaveLength(4);
  });

  it('leaves files with edits unchanged, on their old base, so that saving asks', async () => {
    store().setFileText('actions/Go.py', 'mine');
    serverHas(2, [
      projectFile('actions/Go.py', 2, 'theirs'),
      projectFile('actions/Turn.py', 2, 'turned'),
      projectFile('trees/Main.json', 1, oneBlock('Main', 'Go')),
    ]);
    await catchUp('p1', notice(2), onTaken);
    expect(store().currentText('actions/Go.py')).toBe('mine');
    expect(store().currentText('actions/Turn.py')).toBe('turned');
    expect(store().pendingChanges()).toEqual([{ path: 'actions/Go.py', base_revision: 1, content: 'mine' }]);
  });

  it('is ignored when this page made it', async () => {
    const get = vi.spyOn(api, 'getProject');
    get.mockClear();
    await catchUp('p1', notice(1), onTaken);
    expect(get).not.toHaveBeenCalled();
    expect(onTaken).not.toHaveBeenCalled();
  });

  it('is no conflict when both sides wrote the same', async () => {
    store().setFileText('actions/Go.py', 'same');
    serverHas(2, [
      projectFile('actions/Go.py', 2, 'same'),
      projectFile('actions/Turn.py', 1, 'turn'),
      projectFile('trees/Main.json', 1, oneBlock('Main', 'Go')),
    ]);
    await catchUp('p1', notice(2), onTaken);
    expect(store().pendingChanges()).toEqual([]);
  });

  it('keeps the steps of this page that it does not touch, and tells how many others are lost', async () => {
    store().apply('Main', 'rename', [setName('n1', 'mine')]);
    store().apply('Main', 'comment', [setComment('n1', 'why')]);
    serverHas(2, [projectFile('trees/Main.json', 2, saved({ name: 'mine', comment: 'why', color: 'red' }))]);
    const sent = store().pendingChanges();
    store().applySaved(sent, { revision: 1, files: [], diagnostics: [], actions: [], checked: true });
    await catchUp('p1', notice(2), onTaken);
    expect(onTaken.mock.calls[0]?.[1]).toEqual({ message: 'Edit', lost: 0 });
    serverHas(3, [
      projectFile('trees/Main.json', 3, saved({ name: 'mine', comment: 'theirs', color: 'red' })),
    ]);
    await catchUp('p1', notice(3), onTaken);
    expect(onTaken.mock.calls[1]?.[1]).toEqual({ message: 'Edit', lost: 1 });
    store().undo();
    expect(store().diagrams['Main']?.nodes['n1']).toEqual({ type: 'Go', comment: 'theirs', color: 'red' });
    store().redo();
    expect(store().diagrams['Main']?.nodes['n1']?.name).toBe('mine');
  });
});
