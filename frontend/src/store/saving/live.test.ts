import { beforeEach, describe, expect, it, vi } from 'vitest';
import { api } from '@/api/client';
import type { ProjectDetail, ProjectFile } from '@/api/types';
import { useProjectStore } from '@/store/project';
import { catchUp } from './live';

const file = (path: string, revision: number, content: string): ProjectFile => ({
  path,
  revision,
  size: content.length,
  sha256: '',
  content,
});

const tree = (id: string, type: string) =>
  JSON.stringify({
    format: 'bt-studio/diagram',
    version: 1,
    id,
    root: 'n1',
    nodes: { n1: { type } },
    drafts: [],
  });

function detail(revision: number, files: ProjectFile[]): ProjectDetail {
  return {
    id: 'p1',
    name: 'Test',
    description: '',
    main_tree: 'Main',
    universe: '',
    revision,
    created_at: '',
    updated_at: '',
    root_diagram: null,
    settings: { name: 'Test', main_tree: 'Main' },
    files,
    actions: [],
    diagnostics: [],
  };
}

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
      file('actions/Go.py', 1, 'go'),
      file('actions/Turn.py', 1, 'turn'),
      file('trees/Main.json', 1, tree('Main', 'Go')),
    ]),
  );
});

describe('a revision that was made elsewhere', () => {
  it('is taken over, with files that are new, changed and gone', async () => {
    serverHas(2, [
      file('actions/Go.py', 2, 'go on'),
      file('actions/New.py', 2, 'new'),
      file('trees/Main.json', 2, tree('Main', 'Turn')),
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

  it('leaves what is edited here alone, on its old base, so that saving asks', async () => {
    store().setFileText('actions/Go.py', 'mine');
    serverHas(2, [
      file('actions/Go.py', 2, 'theirs'),
      file('actions/Turn.py', 2, 'turned'),
      file('trees/Main.json', 1, tree('Main', 'Go')),
    ]);
    await catchUp('p1', notice(2), onTaken);
    expect(store().currentText('actions/Go.py')).toBe('mine');
    expect(store().currentText('actions/Turn.py')).toBe('turned');
    expect(store().pendingChanges()).toEqual([{ path: 'actions/Go.py', base_revision: 1, content: 'mine' }]);
  });

  it('is no news when this page made it', async () => {
    const get = vi.spyOn(api, 'getProject');
    get.mockClear();
    await catchUp('p1', notice(1), onTaken);
    expect(get).not.toHaveBeenCalled();
    expect(onTaken).not.toHaveBeenCalled();
  });

  it('is no conflict when both sides wrote the same', async () => {
    store().setFileText('actions/Go.py', 'same');
    serverHas(2, [
      file('actions/Go.py', 2, 'same'),
      file('actions/Turn.py', 1, 'turn'),
      file('trees/Main.json', 1, tree('Main', 'Go')),
    ]);
    await catchUp('p1', notice(2), onTaken);
    expect(store().pendingChanges()).toEqual([]);
  });
});
