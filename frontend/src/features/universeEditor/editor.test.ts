import { describe, expect, it } from 'vitest';
import { select, travel } from '@/features/editor3d/editing';
import { move } from '@/model/universe/edits';
import { useProjectStore } from '@/store/project';
import { lookOnly, openUniverse, UNIVERSE } from '../../../harness/documents';
import { edit, editorOf, GRIDS, readingOf } from './editor';

const text = () => useProjectStore.getState().currentText(UNIVERSE);

describe('the editor of a universe', () => {
  it('is the same for a path, and begins with a grid that the toolbar offers', () => {
    const editor = openUniverse();
    expect(editorOf(UNIVERSE)).toBe(editor);
    expect(editor.store.getState().grid).toBe(0.1);
    expect(GRIDS).toContain(editor.store.getState().grid);
  });

  it('applies the edit to the text, and selects what it returns', () => {
    const editor = openUniverse();
    edit(editor, 'move', (universe) => ({ ...move(universe, ['crate'], [1, 0, 0]), select: ['ball'] }));
    expect(text()).toContain('{id: crate, shape: box, size: [0.4, 0.4, 0.4], pose: [2, 2, 0.2, 0, 0, 0]');
    expect(editor.store.getState().selection).toEqual(['ball']);
    expect(editor.store.getState().undoStack.past.map(({ label }) => label)).toEqual(['move']);
  });

  it('makes no step of an edit without effect', () => {
    const editor = openUniverse();
    edit(editor, 'nothing', () => ({ ops: [] }));
    expect(editor.store.getState().undoStack.past).toEqual([]);
  });

  it('joins edits of one key', () => {
    const editor = openUniverse();
    for (const mergeKey of ['a', 'a', 'b'])
      edit(editor, 'move', (universe) => move(universe, ['crate'], [1, 0, 0]), { mergeKey });
    expect(editor.store.getState().undoStack.past).toHaveLength(2);
  });

  it('selects after undo only what is still there', () => {
    const editor = openUniverse();
    select(editor, ['crate']);
    edit(editor, 'move', (universe) => move(universe, ['crate'], [1, 0, 0]));
    edit(editor, 'rename', () => ({
      ops: [{ kind: 'remove', path: ['models'], indexes: [0] }],
      select: ['ball'],
    }));
    travel(editor, 'undo');
    expect(editor.store.getState().selection).toEqual(['crate']);
    travel(editor, 'redo');
    expect(editor.store.getState().selection).toEqual(['ball']);
  });

  it('leaves an unreadable text, and that of a read-only project, unchanged', () => {
    const broken = openUniverse('models: [');
    edit(broken, 'move', () => ({ ops: [{ kind: 'unset', path: ['models'] }] }));
    expect(text()).toBe('models: [');
    expect(readingOf(broken).universe).toBeNull();
    const editor = openUniverse();
    const before = text();
    lookOnly();
    edit(editor, 'move', (universe) => move(universe, ['crate'], [1, 0, 0]));
    expect(text()).toBe(before);
  });
});
