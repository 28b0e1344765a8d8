import { act } from '@testing-library/react';
import { Position, type EdgeProps } from '@xyflow/react';
import { beforeEach, describe, expect, it } from 'vitest';
import { useLiveStore } from '@/store/project/live';
import { elbow } from '@/ui/shapes';
import { forgetEditor, showInFlow } from '../../../harness/canvas';
import type { TreeEdge as TreeEdgeType } from './flow';
import { useDraggedBlocks } from './gestures/draggedBlocks';
import { TreeEdge } from './TreeEdge';

beforeEach(() => forgetEditor());

function open(more: Partial<Record<keyof EdgeProps, unknown>> = {}) {
  const props = {
    id: 'a',
    source: 'r',
    target: 'a',
    sourceX: 10,
    sourceY: 20,
    targetX: 110,
    targetY: 90,
    sourcePosition: Position.Bottom,
    targetPosition: Position.Top,
    data: { tree: 'Main', node: 'a', isHorizontal: false },
    ...more,
  } as EdgeProps<TreeEdgeType>;
  showInFlow(
    <svg>
      <TreeEdge {...props} />
    </svg>,
  );
  const edge = document.querySelector<SVGElement>('g[class*=edge]')!;
  return { edge, path: () => edge.querySelector('.react-flow__edge-path')!.getAttribute('d') };
}

describe('TreeEdge', () => {
  it('bends from the parent to the block, and is easy to hit', () => {
    const { edge, path } = open();
    expect(path()).toBe(elbow(10, 20, 110, 90, false));
    expect(edge.dataset['status']).toBe('IDLE');
    expect(edge).not.toHaveAttribute('data-selected');
    expect(edge.querySelector('.react-flow__edge-interaction')).toHaveAttribute('stroke-width', '18');
  });

  it('runs to the right in a left-right tree', () => {
    const data = { tree: 'Main', node: 'a', isHorizontal: true };
    expect(open({ data, selected: true }).path()).toBe(elbow(10, 20, 110, 90, true));
    expect(document.querySelector('g[data-selected]')).not.toBeNull();
  });

  it('has the status of its child block, in its own tree', () => {
    const { edge } = open({ target: 's d', data: { tree: 'Dock', node: 'd', isHorizontal: false } });
    act(() => useLiveStore.setState({ statuses: new Map([['Main/a', 'FAILURE']]) }));
    expect(edge.dataset['status']).toBe('IDLE');
    act(() => useLiveStore.setState({ statuses: new Map([['Dock/d', 'RUNNING']]) }));
    expect(edge.dataset['status']).toBe('RUNNING');
  });

  it('follows the dragged block, and no other', () => {
    const { path } = open();
    act(() => useDraggedBlocks.setState({ tops: new Set(['a']), dx: 7, dy: -9 }));
    expect(path()).toBe(elbow(10, 20, 117, 81, false));
    act(() => useDraggedBlocks.setState({ tops: new Set(['b']), dx: 7, dy: -9 }));
    expect(path()).toBe(elbow(10, 20, 110, 90, false));
    act(() => useDraggedBlocks.setState({ tops: new Set(), dx: 0, dy: 0 }));
  });

  it('is straight, and named by its target, without data', () => {
    const { edge, path } = open({ data: undefined, targetX: 10 });
    expect(path()).toBe('M10 20L10 90');
    act(() => useLiveStore.setState({ statuses: new Map([['/a', 'SUCCESS']]) }));
    expect(edge.dataset['status']).toBe('SUCCESS');
  });
});
