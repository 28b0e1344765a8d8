import { describe, expect, it } from 'vitest';
import { select } from '@/features/editor3d/editing';
import type { Thing } from '@/model/universe/types';
import { openUniverse } from '../../../harness/documents';
import { readingOf, type UniverseEditor } from './editor';
import { keysOf } from './keyboard';

const thing = (editor: UniverseEditor, id: string): Thing | undefined =>
  readingOf(editor).universe?.things.find((each) => each.id === id);

describe('the keys of a universe', () => {
  it('move, turn, copy and delete what is selected', () => {
    const editor = openUniverse();
    const keys = keysOf(editor);
    select(editor, ['crate']);
    keys.nudge(1, 0, 0, 5);
    expect(thing(editor, 'crate')).toMatchObject({ pose: [1.5, 2, 0.2, 0, 0, 0] });
    keys.turn(-1);
    expect(thing(editor, 'crate')).toMatchObject({ pose: [1.5, 2, 0.2, 0, 0, -0.2618] });
    keys.duplicate();
    expect(thing(editor, 'crate_2')).toBeDefined();
    keys.remove();
    expect(thing(editor, 'crate_2')).toBeUndefined();
  });

  it('select everything that can be selected, in the order of the document', () => {
    const editor = openUniverse();
    expect(keysOf(editor).all()).toEqual(['crate', 'ball', 'carpet', 'walker', 'robot']);
    expect(keysOf(editor).modes).toEqual(['move', 'turn', 'size']);
    expect(keysOf(openUniverse('[')).all()).toEqual([]);
  });

  it('start and end the wall tool', () => {
    const editor = openUniverse();
    const wall = keysOf(editor).others?.['w'];
    wall?.(editor, {} as never);
    expect(editor.store.getState().tool).toBe('wall');
    wall?.(editor, {} as never);
    expect(editor.store.getState().tool).toBe('select');
  });
});
