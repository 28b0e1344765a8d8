import { describe, expect, it } from 'vitest';
import { produceWithPatches } from 'immer';
import './edits';
import { emptyUndo, record, redo, seal, undo, type UndoStack } from './undo';

interface Doc {
  readonly value: number;
}

function step(
  doc: Doc,
  undoStack: UndoStack,
  value: number,
  mergeKey: string | null = null,
): [Doc, UndoStack] {
  const [next, patches, inverse] = produceWithPatches(doc, (draft) => {
    draft.value = value;
  });
  return [next, record(undoStack, { label: 'set', mergeKey, patches, inverse, before: [], after: [] })];
}

describe('the undo stack', () => {
  it('goes back and forth', () => {
    let [doc, undoStack] = step({ value: 0 }, emptyUndo, 1);
    [doc, undoStack] = step(doc, undoStack, 2);
    const back = undo(doc, undoStack);
    expect(back?.document).toEqual({ value: 1 });
    expect(back && redo(back.document, back.undoStack)?.document).toEqual({ value: 2 });
    expect(undo(doc, emptyUndo)).toBeNull();
    expect(redo(doc, undoStack)).toBeNull();
  });
  it('merges steps of one gesture, until it is sealed', () => {
    let [doc, undoStack] = step({ value: 0 }, emptyUndo, 1, 'typing');
    [doc, undoStack] = step(doc, undoStack, 2, 'typing');
    expect(undoStack.past).toHaveLength(1);
    expect(undo(doc, undoStack)?.document).toEqual({ value: 0 });
    [doc, undoStack] = step(doc, seal(undoStack), 3, 'typing');
    expect(undoStack.past).toHaveLength(2);
    expect(undo(doc, undoStack)?.document).toEqual({ value: 2 });
  });
  it('clears redo after a new step, and ignores empty steps', () => {
    const [doc, undoStack] = step({ value: 0 }, emptyUndo, 1);
    const back = undo(doc, undoStack);
    const [, next] = step(back!.document, back!.undoStack, 5);
    expect(next.future).toEqual([]);
    expect(record(next, { label: '', mergeKey: null, patches: [], inverse: [], before: [], after: [] })).toBe(
      next,
    );
  });
});
