import { act } from '@testing-library/react';
import { describe, expect, it, onTestFinished } from 'vitest';
import { undoTarget } from '@/commands/undo';
import { useProjectStore } from '@/store/project';
import { useTabs } from '@/workspace/tabs';
import { lookOnly, openUniverse, UNIVERSE } from '../../../harness/documents';
import { show } from '../../../harness/testing';
import { change, type Editor } from './editing';
import { recordImport, useImported } from './imported';
import { useUndoInFront } from './useUndoInFront';

function Tab({ editor }: { readonly editor: Editor }) {
  useUndoInFront(editor);
  return null;
}

const front = (path: string | null) => {
  act(() => useTabs.setState({ front: path === null ? null : { kind: 'file', path } }));
};

function begin() {
  const editor = openUniverse('a: 1\n');
  onTestFinished(() => front(null));
  return { editor, ...show(<Tab editor={editor} />) };
}

describe('undo of the document in front', () => {
  it('is that of this editor while it is in front', () => {
    const { unmount } = begin();
    expect(undoTarget()).toBeNull();
    front('other.yaml');
    expect(undoTarget()).toBeNull();
    front(UNIVERSE);
    expect(undoTarget()).toMatchObject({ canUndo: false, canRedo: false });
    front(null);
    expect(undoTarget()).toBeNull();
    front(UNIVERSE);
    unmount();
    expect(undoTarget()).toBeNull();
  });

  it('reports whether there is something to undo and redo, and does it', () => {
    const { editor } = begin();
    front(UNIVERSE);
    act(() => change(editor, 'one', () => ({ texts: ['a: 2\n'] })));
    expect(undoTarget()).toMatchObject({ canUndo: true, canRedo: false });
    act(() => undoTarget()?.travel('undo'));
    expect(useProjectStore.getState().currentText(UNIVERSE)).toBe('a: 1\n');
    expect(undoTarget()).toMatchObject({ canUndo: false, canRedo: true });
  });

  it('offers to take an import back while its texts are as they were', () => {
    begin();
    front(UNIVERSE);
    const part = {
      ...{ revision: 1, previous_revision: 1, path: UNIVERSE, name: 'hall', paths: [UNIVERSE], removed: [] },
      ...{
        report: { taken: [], assumed: [], left_out: [] },
        test_drive: null,
        can_simplify: false,
        things: 1,
      },
    };
    onTestFinished(() => useImported.setState({ step: null }));
    act(() => recordImport(part, 'universe', { files: {}, settings: null }));
    expect(undoTarget()).toMatchObject({ canUndo: true });
    act(() => useProjectStore.getState().setFileText(UNIVERSE, 'a: 9\n'));
    expect(undoTarget()).toMatchObject({ canUndo: false });
  });

  it('offers nothing in a read-only project', () => {
    const editor = openUniverse('a: 1\n');
    change(editor, 'one', () => ({ texts: ['a: 2\n'] }));
    lookOnly();
    onTestFinished(() => front(null));
    show(<Tab editor={editor} />);
    front(UNIVERSE);
    expect(undoTarget()).toMatchObject({ canUndo: false, canRedo: false });
  });
});
