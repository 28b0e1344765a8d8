import { act, fireEvent, renderHook, screen } from '@testing-library/react';
import { beforeEach, describe, expect, it, vi } from 'vitest';
import { childrenOf } from '@/model/diagram';
import { useProjectStore } from '@/store/project';
import { now, openDiagram } from '../../../harness/canvas';
import { show } from '../../../harness/testing';
import { Outline } from './Outline';
import { useRowDrag } from './useRowDrag';

const row = (id: string) => document.getElementById(`outline-${id}`)!;
const lines = ['r', 'a', 'b', 'f', 'x'];
/** Returns the height in the list, in px, of a place within a line; `share` is from 0 to 1. */
const yOf = (id: string, share: number) => 28 * (lines.indexOf(id) + share);

beforeEach(() => {
  openDiagram({
    root: 'r',
    nodes: {
      r: { type: 'Sequence', children: ['a', 'b', 'f'] },
      a: { type: 'Sleep' },
      b: { type: 'Sleep' },
      f: { type: 'Fallback', children: ['x'] },
      x: { type: 'Sleep' },
    },
  });
  // jsdom has no layout: the list begins at the top of the window.
  vi.spyOn(Element.prototype, 'clientHeight', 'get').mockReturnValue(560);
  vi.spyOn(Element.prototype, 'clientWidth', 'get').mockReturnValue(240);
  show(<Outline />);
});

function drag(id: string, onto: string, share: number, button = 0): void {
  fireEvent.pointerDown(row(id), { clientX: 20, clientY: yOf(id, 0.5), pointerId: 1, button });
  fireEvent.pointerMove(row(id), { clientX: 20, clientY: yOf(onto, share), pointerId: 1 });
}
const drop = () => act(() => void fireEvent.pointerUp(document.body, { pointerId: 1 }));
const marks = () => screen.getAllByRole('treeitem').map((each) => each.dataset['mark']);

describe('a line of the outline', () => {
  it('is moved among its siblings, with a mark on the way, as one step', () => {
    drag('b', 'a', 0.1);
    expect(row('a')).toHaveAttribute('data-mark', 'before');
    drop();
    expect(childrenOf(now.diagram(), 'r')).toEqual(['b', 'a', 'f']);
    expect(now.selection()).toEqual(['b']);
    expect(marks()).not.toContain('before');
    act(() => useProjectStore.getState().undo());
    expect(childrenOf(now.diagram(), 'r')).toEqual(['a', 'b', 'f']);
  });

  it('is moved below another block', () => {
    drag('a', 'f', 0.5);
    expect(row('f')).toHaveAttribute('data-mark', 'onto');
    drop();
    expect(childrenOf(now.diagram(), 'f')).toEqual(['x', 'a']);
  });

  it('moves together with the other selected lines', () => {
    act(() => useProjectStore.getState().select('Main', ['b', 'a']));
    drag('b', 'f', 0.5);
    drop();
    expect(childrenOf(now.diagram(), 'f')).toEqual(['x', 'a', 'b']);
  });

  it('stays in place after Escape, at its own place, and after a click', () => {
    const before = now.diagram();
    drag('a', 'f', 0.5);
    act(() => void fireEvent.keyDown(document.body, { key: 'Escape' }));
    drop();
    drag('a', 'b', 0.1);
    expect(marks()).toEqual(lines.map(() => undefined));
    drop();
    drag('f', 'x', 0.5);
    drop();
    drag('a', 'a', 0.6);
    drop();
    expect(now.diagram()).toBe(before);
  });

  it('is not the root, and not moved by another button', () => {
    const before = now.diagram();
    drag('r', 'f', 0.5);
    drop();
    drag('a', 'f', 0.5, 2);
    drop();
    expect(now.diagram()).toBe(before);
  });

  it('is not revealed by the click at the end of a drag', () => {
    drag('a', 'b', 0.1);
    drop();
    fireEvent.click(row('a'));
    expect(now.selection()).toEqual([]);
    drag('a', 'a', 0.5);
    drop();
    fireEvent.click(row('a'));
    expect(now.selection()).toEqual(['a']);
  });
});

it('marks nothing without a press, and moves nothing in a closed tree', () => {
  const { result } = renderHook(() => useRowDrag({ current: document.body }, undefined, [], 28));
  const press = { button: 0, pointerType: 'mouse', currentTarget: document.body, pointerId: 1 };
  act(() => result.current.onPress(press as unknown as Parameters<typeof result.current.onPress>[0], 'a'));
  fireEvent.pointerMove(document.body, { clientX: 90, clientY: 90, pointerId: 1 });
  expect(result.current.slot).toBeNull();
  expect(result.current.wasDragged.current).toBe(false);
});
