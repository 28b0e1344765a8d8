import { act, fireEvent } from '@testing-library/react';
import type { Connection, FinalConnectionState } from '@xyflow/react';
import { beforeEach, describe, expect, it, onTestFinished } from 'vitest';
import { childrenOf } from '@/model/diagram';
import { inFlow, now, openDiagram } from '../../../../harness/canvas';
import { useTree } from '../useTree';
import { useConnecting } from './useConnecting';

beforeEach(() => {
  openDiagram({
    root: 'r',
    nodes: {
      r: { type: 'Sequence', children: ['f', 'i'] },
      f: { type: 'Fallback', children: ['a'] },
      a: { type: 'Sleep' },
      i: { type: 'Inverter', children: ['c'] },
      c: { type: 'AlwaysSuccess' },
      d: { type: 'Sleep' },
      g: { type: 'Sequence' },
    },
    drafts: ['d', 'g'],
  });
});

const begin = () => inFlow(() => useConnecting(useTree('Main'))).used;
const connection = (source: string, target: string): Connection => ({
  source,
  target,
  sourceHandle: null,
  targetHandle: null,
});

interface End {
  readonly from?: string | null;
  readonly type?: 'source' | 'target';
  readonly isValid?: boolean;
  /** The block below the pointer. */
  readonly onto?: string;
  readonly start?: { x: number; y: number };
}

/** Ends a connection at the point (100, 100) of the window. */
function end(used: ReturnType<typeof begin>, { from = 'r', type = 'source', onto, ...more }: End) {
  const block = document.createElement('div');
  block.className = 'react-flow__node';
  if (onto !== undefined) block.setAttribute('data-id', onto);
  const part = block.appendChild(document.createElement('span'));
  Object.assign(document, { elementFromPoint: () => (onto === undefined ? document.body : part) });
  onTestFinished(() => {
    Reflect.deleteProperty(document, 'elementFromPoint');
  });
  const state = {
    isValid: more.isValid ?? false,
    fromNode: from === null ? null : { id: from },
    fromHandle: { type },
    from: more.start ?? { x: 0, y: 0 },
  };
  const event = { clientX: 100, clientY: 100 } as MouseEvent;
  act(() => used().onConnectEnd(event, state as unknown as FinalConnectionState));
}

describe('a connection', () => {
  it('can end at a block that may be a child, and is not one yet', () => {
    const used = begin();
    const isValid = (source: string, target: string) => used().isValidConnection(connection(source, target));
    expect(isValid('r', 'd')).toBe(true);
    expect(isValid('g', 'a')).toBe(true);
    expect(isValid('r', 'f')).toBe(false);
    expect(isValid('i', 'd')).toBe(false);
    expect(isValid('f', 'r')).toBe(false);
  });

  it('makes the block a child of the other', () => {
    const used = begin();
    act(() => used().onConnect(connection('f', 'd')));
    expect(childrenOf(now.diagram(), 'f')).toEqual(['a', 'd']);
    expect(now.diagram().drafts).toEqual(['g']);
    expect(now.selection()).toEqual(['d']);
  });
});

describe('a connection that ends', () => {
  it('on a block makes that a child', () => {
    end(begin(), { from: 'f', onto: 'd' });
    expect(childrenOf(now.diagram(), 'f')).toEqual(['a', 'd']);
    expect(now.editor().quickAdd).toBeNull();
  });

  it('on an ancestor changes nothing', () => {
    end(begin(), { from: 'f', onto: 'r' });
    expect(childrenOf(now.diagram(), 'f')).toEqual(['a']);
  });

  it('begun at the top of a block makes that a child of the other', () => {
    end(begin(), { from: 'd', type: 'target', onto: 'g' });
    expect(childrenOf(now.diagram(), 'g')).toEqual(['d']);
  });

  it('on its own block opens the quick-add box', () => {
    end(begin(), { from: 'f', onto: 'f' });
    expect(now.editor().quickAdd).not.toBeNull();
  });

  it('on the empty canvas asks for a child', () => {
    end(begin(), { from: 'f' });
    expect(now.editor().quickAdd).toEqual({
      tree: 'Main',
      goal: { does: 'add', place: { at: 'child', parent: 'f', index: 1 } },
      x: 100,
      y: 100,
      text: '',
    });
  });

  it('on the empty canvas above a block asks for a parent', () => {
    end(begin(), { from: 'a', type: 'target' });
    expect(now.editor().quickAdd).toMatchObject({ goal: { does: 'wrap', nodes: ['a'] }, x: 100, y: 100 });
  });

  it.each([
    [{ x: 100, y: 89 }, false],
    [{ x: 88, y: 100 }, true],
    [{ x: 92, y: 92 }, false],
  ])('at %o was a drag, and not a press: %s', (start, isDrawn) => {
    end(begin(), { from: 'f', start });
    expect(now.editor().quickAdd !== null).toBe(isDrawn);
  });

  it('that is made, that is not at a block, or that is a touch opens no box', () => {
    const used = begin();
    end(used, { isValid: true });
    end(used, { from: null });
    act(() =>
      used().onConnectEnd(
        { touches: [] } as unknown as TouchEvent,
        { fromNode: { id: 'r' } } as FinalConnectionState,
      ),
    );
    expect(now.editor().quickAdd).toBeNull();
  });
});

it('is not made after Escape, and the next one is', () => {
  const used = begin();
  const start = () => {
    const event = { target: document.body } as unknown as MouseEvent;
    act(() => used().onConnectStart(event));
  };
  start();
  fireEvent.keyDown(document.body, { key: 'Escape' });
  act(() => used().onConnect(connection('f', 'd')));
  end(used, { from: 'f', onto: 'd' });
  end(used, { from: 'f' });
  expect(childrenOf(now.diagram(), 'f')).toEqual(['a']);
  expect(now.editor().quickAdd).toBeNull();
  start();
  act(() => used().onConnect(connection('f', 'd')));
  expect(childrenOf(now.diagram(), 'f')).toEqual(['a', 'd']);
});
