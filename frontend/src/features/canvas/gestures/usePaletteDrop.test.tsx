import { act } from '@testing-library/react';
import type { DragEvent } from 'react';
import { beforeEach, describe, expect, it, vi } from 'vitest';
import { childrenOf } from '@/model/diagram';
import { removeSubtrees } from '@/model/edits';
import { setEditor, useEditorStore } from '@/store/project/editor';
import { useProjectStore } from '@/store/project';
import { inFlow, now, openDiagram } from '../../../../harness/canvas';
import { nodeOf } from '../../../../harness/testing';
import { useTree } from '../useTree';
import { usePaletteDrop } from './usePaletteDrop';

beforeEach(() => {
  openDiagram({
    root: 'r',
    nodes: { r: { type: 'Sequence', children: ['a'] }, a: { type: 'Fallback', children: [] } },
  });
});

const away = { x: 905.4, y: 800.6 };

function begin() {
  const { used } = inFlow(() => {
    const tree = useTree('Main');
    return { tree, ...usePaletteDrop(tree) };
  });
  const event = ({ x, y }: { x: number; y: number }) => {
    const preventDefault = vi.fn();
    const dataTransfer = { dropEffect: 'none' };
    const drag = { clientX: x, clientY: y, preventDefault, dataTransfer };
    return { preventDefault, dataTransfer, drag: drag as unknown as DragEvent };
  };
  const over = (point: { x: number; y: number }) => {
    const made = event(point);
    act(() => used().onDragOver(made.drag));
    return made;
  };
  const drop = (point: { x: number; y: number }) => {
    const made = event(point);
    act(() => used().onDrop(made.drag));
    return made;
  };
  const centreOf = (id: string) => {
    const { x, y, width, height } = used().tree.layout.positions[id]!;
    return { x: x + width / 2, y: y + height / 2 };
  };
  return { used, over, drop, centreOf };
}

const fromPalette = () => setEditor({ dragged: { type: 'Sleep' } });

describe('a block from the palette', () => {
  it('marks the slot below it, setting it once', () => {
    fromPalette();
    const { over, centreOf } = begin();
    const { preventDefault, dataTransfer } = over(centreOf('a'));
    expect(preventDefault).toHaveBeenCalledOnce();
    expect(dataTransfer.dropEffect).toBe('copy');
    expect(now.editor().slot).toMatchObject({ kind: 'onto', parent: 'a', index: 0 });
    const changed = vi.fn();
    const end = useEditorStore.subscribe(changed);
    over(centreOf('a'));
    expect(changed).not.toHaveBeenCalled();
    over(away);
    expect(now.editor().slot).toBeNull();
    expect(changed).toHaveBeenCalledOnce();
    end();
  });

  it('becomes a child of the block where it is dropped', () => {
    fromPalette();
    const { over, drop, centreOf } = begin();
    over(centreOf('a'));
    expect(drop(centreOf('a')).preventDefault).toHaveBeenCalledOnce();
    const [made] = childrenOf(now.diagram(), 'a');
    expect(nodeOf('Main', made!)).toEqual({ type: 'Sleep' });
    expect(now.selection()).toEqual([made]);
    expect(now.editor()).toMatchObject({ dragged: null, slot: null });
  });

  it('becomes a draft around the pointer on the empty canvas', () => {
    fromPalette();
    const { drop } = begin();
    drop(away);
    const [made] = now.diagram().drafts;
    expect(nodeOf('Main', made!)).toEqual({ type: 'Sleep', position: [835, 779] });
  });

  it('becomes the root of an empty tree', () => {
    fromPalette();
    useProjectStore.getState().apply('Main', 'delete', [removeSubtrees(['r'])]);
    const { drop } = begin();
    drop(away);
    expect(nodeOf('Main', now.diagram().root!)?.type).toBe('Sleep');
    expect(now.diagram().drafts).toEqual([]);
  });

  it('finds the slots of the current tree', () => {
    fromPalette();
    const { over, drop, centreOf } = begin();
    over(centreOf('a'));
    drop(centreOf('a'));
    fromPalette();
    const [first] = childrenOf(now.diagram(), 'a');
    over({ x: centreOf(first!).x + 40, y: centreOf(first!).y });
    expect(now.editor().slot).toMatchObject({ kind: 'between', parent: 'a', index: 1 });
  });
});

describe('anything else that is dragged', () => {
  it('is left to the browser', () => {
    const { over, drop, centreOf } = begin();
    expect(over(centreOf('a')).preventDefault).not.toHaveBeenCalled();
    expect(drop(centreOf('a')).preventDefault).not.toHaveBeenCalled();
    expect(now.editor().slot).toBeNull();
    expect(Object.keys(now.diagram().nodes)).toEqual(['r', 'a']);
  });
});

it('removes the mark when it leaves the canvas, but not over a block inside', () => {
  fromPalette();
  const { used, over, centreOf } = begin();
  over(centreOf('a'));
  const canvas = document.createElement('div');
  const inner = canvas.appendChild(document.createElement('div'));
  const leave = (relatedTarget: Element) =>
    act(() => used().onDragLeave({ currentTarget: canvas, relatedTarget } as unknown as DragEvent));
  leave(inner);
  expect(now.editor().slot).not.toBeNull();
  leave(document.body);
  expect(now.editor().slot).toBeNull();
});
