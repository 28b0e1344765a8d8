import { describe, expect, it } from 'vitest';
import { produceWithPatches } from 'immer';
import './edits';
import { emptyHistory, record, redo, seal, undo, type History } from './undo';

interface Doc {
  readonly value: number;
}

function step(doc: Doc, history: History, value: number, mergeKey: string | null = null): [Doc, History] {
  const [next, patches, inverse] = produceWithPatches(doc, (draft) => {
    draft.value = value;
  });
  return [next, record(history, { label: 'set', mergeKey, patches, inverse, before: [], after: [] })];
}

describe('history', () => {
  it('goes back and forth', () => {
    let [doc, history] = step({ value: 0 }, emptyHistory, 1);
    [doc, history] = step(doc, history, 2);
    const back = undo(doc, history);
    expect(back?.document).toEqual({ value: 1 });
    expect(back && redo(back.document, back.history)?.document).toEqual({ value: 2 });
    expect(undo(doc, emptyHistory)).toBeNull();
    expect(redo(doc, history)).toBeNull();
  });
  it('merges steps of one gesture, until it is sealed', () => {
    let [doc, history] = step({ value: 0 }, emptyHistory, 1, 'typing');
    [doc, history] = step(doc, history, 2, 'typing');
    expect(history.past).toHaveLength(1);
    expect(undo(doc, history)?.document).toEqual({ value: 0 });
    [doc, history] = step(doc, seal(history), 3, 'typing');
    expect(history.past).toHaveLength(2);
    expect(undo(doc, history)?.document).toEqual({ value: 2 });
  });
  it('forgets what could be redone when something new is done, and ignores what changes nothing', () => {
    const [doc, history] = step({ value: 0 }, emptyHistory, 1);
    const back = undo(doc, history);
    const [, next] = step(back!.document, back!.history, 5);
    expect(next.future).toEqual([]);
    expect(record(next, { label: '', mergeKey: null, patches: [], inverse: [], before: [], after: [] })).toBe(
      next,
    );
  });
});
