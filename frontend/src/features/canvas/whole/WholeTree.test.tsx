import { act, fireEvent, screen } from '@testing-library/react';
import { beforeEach, describe, expect, it, vi } from 'vitest';
import { emptyDiagram, type Diagram } from '@/model/diagram';
import { useLiveStore } from '@/store/project/live';
import { useProjectStore } from '@/store/project';
import type { ShownProblem } from '@/store/project/problems';
import { openDiagram, PANE, showInFlow } from '../../../../harness/canvas';
import { WholeTree } from './WholeTree';

const leaves = Array.from({ length: 600 }, (_, at) => `n${at}`);
const diagram: Diagram = {
  ...emptyDiagram('Main'),
  root: 'r',
  nodes: {
    r: { type: 'Sequence', name: 'mission', children: ['a', 'b'] },
    a: { type: 'Fallback', name: 'patrol', children: leaves },
    b: { type: 'Sleep', name: 'wait' },
    ...Object.fromEntries(leaves.map((id) => [id, { type: 'Sleep' }])),
  },
};
const [onEnter, onMenu] = [vi.fn(), vi.fn()];
const part = (id: string) => document.querySelector<HTMLElement>(`[data-part="${id}"]`)!;
const piece = () => part('a').querySelector('[data-piece]')!;
const tree = () => screen.getByRole('tree', { name: 'The whole of Main' });
/** The middle of the title of a box, or the start of the piece, in the window. */
const titleOf = (id: string) => ({
  clientX: parseFloat(part(id).style.left) + 20,
  clientY: parseFloat(part(id).style.top) + 5,
});
const firstCell = () => ({
  clientX: parseFloat(part('a').style.left) + 8,
  clientY: parseFloat(part('a').style.top) + 26,
});

function show(more: Partial<Parameters<typeof WholeTree>[0]> = {}) {
  openDiagram(diagram);
  return showInFlow(
    <WholeTree
      diagram={diagram}
      inside={new Map()}
      vocabulary={useProjectStore.getState().vocabulary}
      problems={new Map()}
      selection={new Set()}
      marks={new Map()}
      hits={new Set()}
      onEnter={onEnter}
      onMenu={onMenu}
      {...more}
    />,
  );
}

beforeEach(() => {
  onEnter.mockReset();
  onMenu.mockReset();
});

describe('the whole of a tree', () => {
  it('names the upper blocks, and has the others in a piece with their number', () => {
    show();
    expect(screen.getAllByRole('treeitem').map((item) => item.textContent)).toEqual([
      'mission',
      'patrol600',
      'wait',
    ]);
    expect(part('a')).toHaveTextContent('patrol600');
    expect(part('a')).toHaveAttribute('aria-level', '2');
    expect(screen.getByRole('status')).toHaveTextContent('603 blocks');
    expect(parseFloat(part('r').style.width)).toBe(PANE.width - 24);
  });

  it('shows the live status of its boxes, and in a piece what runs in it', async () => {
    show();
    act(() => {
      const { setTree, setStatuses } = useLiveStore.getState();
      setTree(
        ['r', 'a', 'n7', 'n8'].map((id, uid) => ({
          uid,
          parent: uid - 1,
          tree_id: 'Main',
          node_id: id,
          path: id,
          type: 'Sleep',
          name: id,
        })) as unknown as Parameters<typeof setTree>[0],
      );
      setStatuses([
        [0, 'RUNNING'],
        [1, 'RUNNING'],
        [2, 'SUCCESS'],
        [3, 'RUNNING'],
      ]);
    });
    await vi.waitFor(() => expect(piece()).toHaveAttribute('data-status', 'RUNNING'));
    expect(part('r')).toHaveAttribute('data-status', 'RUNNING');
    expect(part('b')).toHaveAttribute('data-status', 'IDLE');
    act(() => useLiveStore.getState().setStatuses([[3, 'IDLE']]));
    await vi.waitFor(() => expect(piece()).toHaveAttribute('data-status', 'SUCCESS'));
    act(() => useLiveStore.getState().setFault('n9', 'Main', 'broken'));
    await vi.waitFor(() => expect(piece()).toHaveAttribute('data-status', 'FAILURE'));
  });

  it('marks where a search has hits, what is selected, what differs and what is wrong', () => {
    const problem: ShownProblem = {
      source: 'server',
      severity: 'error',
      node: 'n2',
      code: '',
      message: '',
      hint: '',
    };
    show({
      hits: new Set(['b', 'n1', 'n2']),
      selection: new Set(['n5']),
      marks: new Map([['b', 'changed']]),
      problems: new Map([['n2', problem]]),
    });
    expect(part('b')).toHaveAttribute('data-found', 'true');
    expect(piece()).toHaveAttribute('data-found', '2');
    expect(part('r')).not.toHaveAttribute('data-found');
    expect(piece()).toHaveAttribute('data-chosen', 'true');
    expect(part('b')).toHaveAttribute('data-mark', 'changed');
    expect(part('a').querySelector('svg[class*="error"]')).not.toBeNull();
    expect(part('b').querySelector('svg[class*="error"]')).toBeNull();
  });
});

describe('the way into it', () => {
  it('leads to the box or the cell that is pressed', () => {
    show();
    fireEvent.click(part('b'), titleOf('b'));
    fireEvent.click(tree(), titleOf('a'));
    fireEvent.click(tree(), firstCell());
    expect(onEnter.mock.calls).toEqual([['b'], ['a'], ['n0']]);
  });

  it('is zooming in, which does not zoom the page', () => {
    show();
    expect(fireEvent.wheel(tree(), { ...titleOf('a'), ctrlKey: true, deltaY: 3 })).toBe(false);
    expect(onEnter).not.toHaveBeenCalled();
    expect(fireEvent.wheel(tree(), { ...titleOf('a'), ctrlKey: true, deltaY: -3 })).toBe(false);
    expect(onEnter).toHaveBeenCalledExactlyOnceWith('a');
    expect(fireEvent.wheel(tree(), { ...titleOf('a'), deltaY: -3 })).toBe(true);
  });

  it('opens the menu of a block', () => {
    show();
    fireEvent.contextMenu(tree(), firstCell());
    expect(onMenu.mock.calls[0]?.[1]).toBe('n0');
  });

  it('names the block under the pointer', () => {
    show();
    fireEvent.pointerMove(tree(), firstCell());
    expect(document.querySelector('[class*="tip"]')).toHaveTextContent('Sleep');
    fireEvent.pointerMove(tree(), titleOf('a'));
    expect(document.querySelector('[class*="tip"]')).toHaveTextContent('patrolFallback');
    fireEvent.pointerLeave(tree());
    expect(document.querySelector('[class*="tip"]')).toBeNull();
  });
});
