import { act, fireEvent } from '@testing-library/react';
import { useRef } from 'react';
import { beforeEach, describe, expect, it, vi } from 'vitest';
import { childrenOf } from '@/model/diagram';
import { useProjectStore } from '@/store/project';
import { toggleExpanded } from '@/store/project/editor';
import { oneBlock } from '@/store/testing';
import { inFlow, now, openDiagram } from '../../../../harness/canvas';
import { nodeOf } from '../../../../harness/testing';
import type { BlockNode } from '../flow';
import { useTree } from '../useTree';
import { useDraggedBlocks } from './draggedBlocks';
import { useDragging } from './useDragging';

const ids = ['r', 'a', 'b', 'i', 'c', 's'];

beforeEach(() => {
  openDiagram(
    {
      root: 'r',
      nodes: {
        r: { type: 'Sequence', children: ['a', 'b', 'i', 's'] },
        a: { type: 'Sleep', ports: { msec: '1' } },
        b: { type: 'Fallback' },
        i: { type: 'Inverter', children: ['c'] },
        c: { type: 'AlwaysSuccess' },
        s: { type: 'SubTree', tree: 'Dock' },
      },
    },
    { texts: { 'trees/Dock.json': oneBlock('Dock', 'AlwaysSuccess') } },
  );
});

function begin() {
  const canvas = document.createElement('div');
  canvas.innerHTML = [...ids, 's n1']
    .map((id) => `<i class="react-flow__node" data-id="${id}"></i>`)
    .join('');
  const { used, unmount } = inFlow(() => {
    const tree = useTree('Main');
    return { tree, ...useDragging(tree, useRef<HTMLElement | null>(canvas)) };
  });
  const boxOf = (id: string) => used().tree.layout.positions[id]!;
  const centreOf = (id: string) => {
    const { x, y, width, height } = boxOf(id);
    return { x: x + width / 2, y: y + height / 2 };
  };
  /** Returns a block as React Flow reports it during a drag: its offset from its place, and the pointer. */
  const held = (id: string, dx: number, dy: number, pointer: { x: number; y: number }, altKey: boolean) =>
    [
      { clientX: pointer.x, clientY: pointer.y, altKey } as MouseEvent,
      { id, position: { x: boxOf(id).x + dx, y: boxOf(id).y + dy } } as BlockNode,
    ] as const;
  type Step = [id: string, dx: number, dy: number, pointer?: { x: number; y: number }, altKey?: boolean];
  const away = { x: 9000, y: 9000 };
  const drag = (...[id, dx, dy, pointer = away, altKey = false]: Step) =>
    act(() => used().onDrag(...held(id, dx, dy, pointer, altKey)));
  const drop = (...[id, dx, dy, pointer = away, altKey = false]: Step) =>
    act(() => used().onDrop(...held(id, dx, dy, pointer, altKey)));
  const translated = () =>
    [...canvas.querySelectorAll<HTMLElement>('i')]
      .filter(({ style }) => style.translate !== '')
      .map(({ dataset }) => dataset['id']);
  return { used, drag, drop, boxOf, centreOf, translated, unmount, canvas };
}

describe('while a block is dragged', () => {
  it('it moves with its subtree, and is kept drawn', () => {
    const { used, drag, drop, translated } = begin();
    expect(used().held).toBeNull();
    drag('i', 30, 40);
    expect(used().held).toBe('i');
    expect(translated()).toEqual(['i', 'c']);
    expect(useDraggedBlocks.getState()).toEqual({ tops: new Set(['i']), dx: 30, dy: 40 });
    drop('i', 30, 40);
    expect(used().held).toBeNull();
    expect(translated()).toEqual([]);
  });

  it('an expanded subtree moves, too', () => {
    act(() => toggleExpanded('Main', 's'));
    const { drag, translated } = begin();
    drag('s', 30, 40);
    expect(translated()).toEqual(['s', 's n1']);
  });

  it('the slot below the pointer is marked after a first movement', () => {
    const { drag, centreOf } = begin();
    drag('a', 6, 0, centreOf('b'));
    expect(now.editor().slot).toBeNull();
    drag('a', 5, 5, centreOf('b'));
    expect(now.editor().slot).toMatchObject({ kind: 'onto', parent: 'b', index: 0 });
    const { slot } = now.editor();
    drag('a', 8, 8, centreOf('b'));
    expect(now.editor().slot).toBe(slot);
    drag('a', 8, 8);
    expect(now.editor().slot).toBeNull();
  });

  it('its own place is no slot, except for a copy', () => {
    const { drag, boxOf } = begin();
    const [a, b] = [boxOf('a'), boxOf('b')];
    const between = { x: (a.x + a.width + b.x) / 2, y: a.y + 10 };
    drag('a', 20, 0, between);
    expect(now.editor().slot).toBeNull();
    drag('a', 20, 0, between, true);
    expect(now.editor().slot).toMatchObject({ kind: 'between', parent: 'r' });
  });

  it('a touch, or a block that is not in the tree, moves nothing', () => {
    const { used, translated } = begin();
    act(() =>
      used().onDrag(
        { touches: [] } as unknown as TouchEvent,
        { id: 'a', position: { x: 0, y: 0 } } as BlockNode,
      ),
    );
    act(() =>
      used().onDrag(
        { clientX: 1, clientY: 1 } as MouseEvent,
        { id: 'gone', position: { x: 0, y: 0 } } as BlockNode,
      ),
    );
    expect(translated()).toEqual([]);
    expect(used().held).toBeNull();
  });

  it('nothing stays moved when the canvas is removed', () => {
    const { drag, translated, unmount } = begin();
    drag('a', 20, 0);
    expect(translated()).toEqual(['a']);
    unmount();
    expect(translated()).toEqual([]);
  });

  it('the next drag can move another block', () => {
    const { used, drag, translated } = begin();
    drag('a', 20, 0);
    drag('b', 20, 0);
    expect(used().held).toBe('b');
    expect(translated()).toEqual(['b']);
  });
});

describe('Escape', () => {
  const undoSteps = () => useProjectStore.getState().histories['Main']?.past.length ?? 0;

  it('leaves the tree unchanged, and the end of the drag does nothing', () => {
    const { used, drag, drop, centreOf, translated } = begin();
    const before = now.diagram();
    const released = vi.fn();
    window.addEventListener('mouseup', released, { once: true });
    drag('a', 50, 0, centreOf('b'));
    expect(now.editor().slot).not.toBeNull();
    act(() => void fireEvent.keyDown(document.body, { key: 'Escape' }));
    expect(released).toHaveBeenCalledOnce();
    expect(used().held).toBeNull();
    expect(translated()).toEqual([]);
    expect(now.editor().slot).toBeNull();
    // React Flow's drag of a touch continues until the finger is lifted.
    drag('a', 60, 0, centreOf('b'));
    expect(translated()).toEqual([]);
    drop('a', 60, 0, centreOf('b'));
    expect(now.diagram()).toBe(before);
    expect(undoSteps()).toBe(0);
  });

  it('does not affect the next drag', () => {
    const { used, drag, translated } = begin();
    drag('a', 50, 0);
    act(() => void fireEvent.keyDown(document.body, { key: 'Escape' }));
    act(() => used().onDragStart());
    drag('a', 50, 0);
    expect(translated()).toEqual(['a']);
  });
});

describe('Alt', () => {
  const ghosts = (canvas: HTMLElement) => canvas.querySelectorAll('[data-testid=copy-ghost]').length;

  it('shows a copy at once while the pointer rests, and moves the block again when it is released', () => {
    const { drag, drop, translated, canvas, boxOf } = begin();
    const [a, b] = [boxOf('a'), boxOf('b')];
    drag('a', 20, 0, { x: (a.x + a.width + b.x) / 2, y: a.y + 10 });
    expect(now.editor().slot).toBeNull();
    act(() => void fireEvent.keyDown(window, { key: 'Alt' }));
    expect([ghosts(canvas), translated()]).toEqual([1, []]);
    expect(now.editor().slot).not.toBeNull();
    act(() => void fireEvent.keyUp(window, { key: 'Alt' }));
    expect([ghosts(canvas), translated()]).toEqual([0, ['a']]);
    drop('a', 20, 0);
    fireEvent.keyDown(window, { key: 'Alt' });
    expect(ghosts(canvas)).toBe(0);
  });

  it('and Escape together copy nothing', () => {
    const { drag, canvas } = begin();
    const before = now.diagram();
    drag('i', 50, 60, undefined, true);
    expect(ghosts(canvas)).toBe(1);
    act(() => void fireEvent.keyDown(document.body, { key: 'Escape' }));
    expect(ghosts(canvas)).toBe(0);
    expect(now.diagram()).toBe(before);
  });
});

describe('a block that is dropped', () => {
  it('becomes a child of the marked block, in one undo step', () => {
    const { drag, drop, centreOf } = begin();
    drag('a', 50, 0, centreOf('b'));
    drop('a', 50, 0, centreOf('b'));
    expect(childrenOf(now.diagram(), 'b')).toEqual(['a']);
    expect(childrenOf(now.diagram(), 'r')).toEqual(['b', 'i', 's']);
    expect(now.selection()).toEqual(['a']);
    expect(now.editor().slot).toBeNull();
    act(() => useProjectStore.getState().undo());
    expect(childrenOf(now.diagram(), 'r')).toEqual(['a', 'b', 'i', 's']);
  });

  it('stays where it is dropped on the empty canvas', () => {
    const { drag, drop, boxOf } = begin();
    const { x, y } = boxOf('a');
    drag('a', 50, 60);
    drop('a', 50, 60);
    expect(nodeOf('Main', 'a')?.position).toEqual([x + 50, y + 60]);
    expect(now.selection()).toEqual(['a']);
  });

  it('stays in its place after a movement of six pixels', () => {
    const { drag, drop } = begin();
    drag('a', 6, 0);
    drop('a', 6, 0);
    expect(nodeOf('Main', 'a')?.position).toBeUndefined();
    drag('a', 7, 0);
    drop('a', 7, 0);
    expect(nodeOf('Main', 'a')?.position).toBeDefined();
  });

  it('moves with the other selected blocks, by the same distance', () => {
    act(() => useProjectStore.getState().select('Main', ['i', 'c', 'a']));
    const { drag, drop, boxOf } = begin();
    const [a, i] = [boxOf('a'), boxOf('i')];
    drag('a', 10, 20);
    drop('a', 10, 20);
    expect(nodeOf('Main', 'a')?.position).toEqual([a.x + 10, a.y + 20]);
    expect(nodeOf('Main', 'i')?.position).toEqual([i.x + 10, i.y + 20]);
    expect(nodeOf('Main', 'c')?.position).toBeUndefined();
    expect(now.selection()).toEqual(['a', 'i']);
  });

  it('moves alone if it is not one of the selected blocks', () => {
    act(() => useProjectStore.getState().select('Main', ['i', 'b']));
    const { drag, drop } = begin();
    drag('a', 10, 20);
    drop('a', 10, 20);
    expect(nodeOf('Main', 'i')?.position).toBeUndefined();
    expect(now.selection()).toEqual(['a']);
  });

  it('is copied into the slot with Alt', () => {
    const { drag, drop, centreOf } = begin();
    drag('a', 50, 0, centreOf('b'), true);
    drop('a', 50, 0, centreOf('b'), true);
    expect(childrenOf(now.diagram(), 'r')).toEqual(['a', 'b', 'i', 's']);
    const [copy] = childrenOf(now.diagram(), 'b');
    expect(copy).not.toBe('a');
    expect(nodeOf('Main', copy!)).toEqual({ type: 'Sleep', ports: { msec: '1' } });
    expect(now.selection()).toEqual([copy]);
  });

  it('is copied with its subtree to a free place with Alt', () => {
    const { drag, drop, boxOf } = begin();
    const { x, y } = boxOf('i');
    drag('i', 50, 60, undefined, true);
    drop('i', 50, 60, undefined, true);
    const [copy] = now.diagram().drafts;
    expect(nodeOf('Main', copy!)).toMatchObject({ type: 'Inverter', position: [x + 50, y + 60] });
    expect(childrenOf(now.diagram(), copy!)).toHaveLength(1);
    expect(nodeOf('Main', 'i')?.position).toBeUndefined();
  });

  it('does not move to its own place when Alt is released before the button', () => {
    const { drag, drop, boxOf } = begin();
    const [a, b] = [boxOf('a'), boxOf('b')];
    const between = { x: (a.x + a.width + b.x) / 2, y: a.y + 10 };
    drag('a', 20, 0, between, true);
    drop('a', 20, 0, between, false);
    expect(childrenOf(now.diagram(), 'r')).toEqual(['a', 'b', 'i', 's']);
    expect(nodeOf('Main', 'a')?.position).toEqual([a.x + 20, a.y]);
  });
});
