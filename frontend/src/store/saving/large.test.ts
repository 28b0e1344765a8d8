import { beforeEach, describe, expect, it, onTestFinished, vi } from 'vitest';
import { useProjectStore } from '@/store/project';
import { mergeRemote } from '@/store/project/remote';
import { projectDetail, projectFile } from '@/store/testing';
import { canDuplicate, duplicateDocument } from '@/store/project/duplicating';
import { clipboardText, copySelection } from '@/store/project/edits/clipboard';
import { openProject } from '../../../harness/testing';
import { largePaths, loadAllLarge, loadLarge, useLargeFiles, withAllPython, withTexts } from './large';

const left = (path: string, revision = 1) => ({
  ...projectFile(path, revision, ''),
  content: null,
  left_out: true,
});
const store = () => useProjectStore.getState();
const entry = (path: string) => store().files[path];

function answer(answers: Readonly<Record<string, () => Response | Promise<Response>>>) {
  const asked: string[] = [];
  vi.stubGlobal('fetch', async (url: string, init?: RequestInit) => {
    const path = decodeURIComponent(url.replace(/^.*\/files\//, ''));
    asked.push(path);
    init?.signal?.throwIfAborted();
    const found = answers[path];
    if (!found) throw new TypeError('no network');
    return found();
  });
  return asked;
}

const text =
  (content: string, revision = 1) =>
  () =>
    new Response(content, { headers: { 'x-revision': String(revision) } });

beforeEach(() => {
  const files = [projectFile('small.txt', 1, 'small'), left('b/big.py'), left('a.py'), left('c.bin')];
  store().load(projectDetail(1, files));
  onTestFinished(() => {
    vi.unstubAllGlobals();
    store().close();
    useLargeFiles.setState({ failed: {} });
  });
});

describe('large files', () => {
  it('keep a text that was written to them before they were loaded', async () => {
    answer({ 'a.py': text('theirs') });
    store().setFileText('a.py', 'restored');
    await loadLarge('a.py');
    expect(store().currentText('a.py')).toBe('restored');
    expect(store().pendingChanges()).toEqual([{ path: 'a.py', base_revision: 1, content: 'restored' }]);
  });

  it('are loaded before they are duplicated, or the reason is said', async () => {
    answer({ 'a.py': text('x = 1') });
    expect(canDuplicate('a.py')).toBe(true);
    await withTexts(['a.py', 'small.txt']);
    expect(store().currentText(duplicateDocument('a.py') ?? '')).toBe('x = 1');
    await expect(withTexts(['c.bin'])).rejects.toThrow('c.bin: ');
  });

  it('are copied with the blocks that use them', async () => {
    openProject({ trees: { Main: { r: { type: 'Big' } } }, texts: {}, selected: ['r'] });
    const files = { ...store().files };
    const path = 'actions/Big.py';
    files[path] = { path, kind: 'large', text: null, revision: 1, savedText: null };
    useProjectStore.setState({ files });
    answer({ [path]: text('class Big: ...') });
    expect(await copySelection()).toBe(true);
    expect(await clipboardText()).toContain('class Big: ...');
  });

  it('are neither texts nor changes before they are loaded', () => {
    expect(largePaths(store().files)).toEqual(['a.py', 'b/big.py', 'c.bin']);
    expect(store().currentText('a.py')).toBeNull();
    expect(store().pendingChanges()).toEqual([]);
  });

  it('become a text of the revision that came, or binary', async () => {
    const asked = answer({ 'b/big.py': text('x = 1', 3), 'c.bin': text('\0') });
    await Promise.all([loadLarge('b/big.py'), loadLarge('b/big.py'), loadLarge('c.bin')]);
    expect(asked).toEqual(['b/big.py', 'c.bin']);
    expect(entry('b/big.py')).toMatchObject({ kind: 'text', text: 'x = 1', savedText: 'x = 1', revision: 3 });
    expect(entry('c.bin')).toMatchObject({ kind: 'binary', text: null });
    expect(store().pendingChanges()).toEqual([]);
  });

  it('keep what was typed or deleted meanwhile', async () => {
    answer({
      'a.py': () => {
        store().deleteFile('a.py');
        return text('x')();
      },
    });
    await loadLarge('a.py');
    expect(entry('a.py')).toBeUndefined();
  });

  it('say why they cannot be loaded, and can be loaded later', async () => {
    answer({
      'a.py': () => Response.json({ title: 'Busy', detail: 'Wait.', code: 'busy' }, { status: 503 }),
    });
    await loadLarge('a.py');
    await loadLarge('b/big.py');
    expect(useLargeFiles.getState().failed).toMatchObject({
      'a.py': { isOffline: false },
      'b/big.py': { isOffline: true },
    });
    answer({ 'a.py': text('x') });
    await loadLarge('a.py');
    expect(Object.keys(useLargeFiles.getState().failed)).toEqual(['b/big.py']);
  });

  it('are loaded one after the other, until it is cancelled', async () => {
    const stop = new AbortController();
    const asked = answer({
      'a.py': text('x'),
      'b/big.py': () => {
        stop.abort();
        throw new DOMException('', 'AbortError');
      },
    });
    await loadAllLarge(stop.signal);
    expect(asked).toEqual(['a.py', 'b/big.py']);
    expect(largePaths(store().files)).toEqual(['b/big.py', 'c.bin']);
    expect(useLargeFiles.getState().failed).toEqual({});
  });

  it('are all loaded, if they are Python, before something is renamed', async () => {
    answer({ 'a.py': text('x'), 'b/big.py': text('y') });
    await withAllPython();
    expect(largePaths(store().files)).toEqual(['c.bin']);
    store().load(projectDetail(1, [left('a.py'), left('d.py')]));
    await expect(withAllPython()).rejects.toThrow('d.py');
  });

  it('stay loaded when the project is merged, and are large again when another user saved them', async () => {
    answer({ 'a.py': text('x') });
    await loadLarge('a.py');
    useProjectStore.setState((state) => mergeRemote(state, projectDetail(2, [left('a.py')])).data);
    expect(entry('a.py')).toMatchObject({ kind: 'text', text: 'x' });
    store().setFileText('a.py', 'mine');
    const edited = mergeRemote(store(), projectDetail(3, [left('a.py', 3)]));
    expect(edited.kept).toEqual(['a.py']);
    store().setFileText('a.py', 'x');
    useProjectStore.setState((state) => mergeRemote(state, projectDetail(3, [left('a.py', 3)])).data);
    expect(entry('a.py')).toMatchObject({ kind: 'large', text: null, revision: 3 });
  });
});
