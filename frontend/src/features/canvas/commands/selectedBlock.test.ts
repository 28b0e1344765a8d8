import { beforeEach, describe, expect, it } from 'vitest';
import { useProjectStore } from '@/store/project';
import { now, openDiagram } from '../../../../harness/canvas';
import { action, nodeOf, watchNavigation } from '../../../../harness/testing';
import { editSelected, firstSelected, openBlock, toggleFolded, toggleInside } from './selectedBlock';

beforeEach(() => {
  openDiagram(
    {
      root: 'r',
      nodes: {
        r: { type: 'Sequence', children: ['a', 's', 'n', 'g'] },
        a: { type: 'Sleep' },
        s: { type: 'SubTree', tree: 'Dock' },
        n: { type: 'SubTree' },
        g: { type: 'Grasp' },
      },
    },
    { actions: [action('Grasp')] },
  );
});

const select = (...ids: string[]) => useProjectStore.getState().select('Main', ids);

describe('openBlock', () => {
  it('opens the tree of a subtree, and the code of an action', () => {
    const { openTree, openFile } = watchNavigation();
    openBlock(now.diagram(), 's');
    expect(openTree).toHaveBeenCalledExactlyOnceWith('Dock');
    openBlock(now.diagram(), 'g');
    expect(openFile).toHaveBeenCalledExactlyOnceWith('actions/Grasp.py');
    expect(now.editor().editing).toBeNull();
  });

  it.each(['a', 'n', 'r'])('edits the name of %s, which has no document', (id) => {
    const { openTree, openFile } = watchNavigation();
    openBlock(now.diagram(), id);
    expect(now.editor().editing).toEqual({ node: id, field: 'name' });
    expect(openTree).not.toHaveBeenCalled();
    expect(openFile).not.toHaveBeenCalled();
  });

  it('opens nothing for a deleted block', () => {
    openBlock(now.diagram(), 'gone');
    expect(now.editor().editing).toBeNull();
  });
});

it('acts on the block that was selected first', () => {
  expect(firstSelected()).toBeUndefined();
  editSelected('comment');
  expect(now.editor().editing).toBeNull();
  select('a', 'r');
  expect(firstSelected()).toBe('a');
  editSelected('comment');
  expect(now.editor().editing).toEqual({ node: 'a', field: 'comment' });
});

describe('toggleFolded', () => {
  it('folds and unfolds, each in one undo step', () => {
    select('r');
    toggleFolded();
    expect(nodeOf('Main', 'r')?.collapsed).toBe(true);
    toggleFolded();
    expect(nodeOf('Main', 'r')?.collapsed).toBeUndefined();
    const labels = useProjectStore.getState().histories['Main']?.past.map(({ label }) => label);
    expect(labels).toEqual(['fold', 'unfold']);
  });

  it.each([['a'], []])('changes nothing for a block without children: %s', (...ids) => {
    select(...ids);
    toggleFolded();
    expect(useProjectStore.getState().histories['Main']).toBeUndefined();
  });
});

it('expands and collapses the selected subtree', () => {
  toggleInside();
  expect(now.editor().expanded).toEqual({});
  select('s');
  toggleInside();
  expect(now.editor().expanded['Main']).toEqual(new Set(['s']));
  toggleInside();
  expect(now.editor().expanded['Main']).toEqual(new Set());
});
