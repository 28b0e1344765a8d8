import { act, fireEvent, screen } from '@testing-library/react';
import { beforeEach, describe, expect, it } from 'vitest';
import type { OutlineLine } from '@/model/outline';
import { changeBreakpoint, toggleBreakpoint, useBreakpoints } from '@/store/debug/breakpoints';
import { useDebugMarks } from '@/store/debug/marks';
import { useLiveStore } from '@/store/project/live';
import { useProjectStore } from '@/store/project';
import { now, openDiagram } from '../../../harness/canvas';
import { nodeOf, show, user } from '../../../harness/testing';
import { OutlineRow } from './OutlineRow';

beforeEach(() => {
  openDiagram({
    root: 'r',
    nodes: { r: { type: 'Sequence', name: 'Work', children: ['a'] }, a: { type: 'Sleep' } },
  });
});

function open(id: string, more: Partial<OutlineLine> = {}, isSelected = false) {
  const row = { id, depth: 0, hasChildren: false, isFolded: false, isDraft: false, ...more };
  const node = nodeOf('Main', id)!;
  show(
    <OutlineRow
      tree="Main"
      row={row}
      node={node}
      spec={undefined}
      isSelected={isSelected}
      top={84}
      mark={null}
      onPress={() => undefined}
      wasDragged={{ current: false }}
    />,
  );
  return screen.getByRole('treeitem');
}

describe('a line of the outline', () => {
  it('shows the name, and the type if it differs', () => {
    expect(open('r').textContent).toBe('WorkSequence');
    expect(screen.getByRole('treeitem')).not.toHaveAttribute('aria-expanded');
  });

  it('shows the type once if it is the name', () => {
    expect(open('a', { isDraft: true }).textContent).toBe('SleepNot connected');
  });

  it('is indented by its depth', () => {
    const row = open('a', { depth: 2 }, true);
    expect(row).toHaveStyle({ transform: 'translateY(84px)', paddingLeft: '34px' });
    expect(row).toHaveAttribute('aria-level', '3');
    expect(row).toHaveAttribute('aria-selected', 'true');
  });

  it('shows the status in the run, and that the block is disabled', () => {
    act(() =>
      useProjectStore
        .getState()
        .apply('Main', 'disable', [(draft) => void (draft.nodes['a']!.disabled = true)]),
    );
    const row = open('a');
    expect(row).toHaveAttribute('data-disabled', 'true');
    expect(row).toHaveAttribute('data-status', 'IDLE');
    act(() =>
      useLiveStore.setState({
        statuses: new Map([
          ['Main/a', 'RUNNING'],
          ['Dock/a', 'FAILURE'],
        ]),
      }),
    );
    expect(row).toHaveAttribute('data-status', 'RUNNING');
  });

  it('shows the breakpoint of the block, where the tree is held, and what is forced', () => {
    useBreakpoints.setState({ list: [], areOn: true });
    toggleBreakpoint('Main', 'a');
    useDebugMarks.setState({
      held: new Map([['Main/a', 'here']]),
      forced: new Map([['Main/a', { status: 'FAILURE', once: false, after: false, alone: false }]]),
    });
    const row = open('a');
    expect(row).toHaveAttribute('data-held', 'here');
    expect(row).toHaveTextContent('FAILURE');
    const mark = screen.getByRole('img', { name: 'Breakpoint' });
    expect(mark).not.toHaveAttribute('data-off');
    act(() => changeBreakpoint('Main', 'a', { on: false }));
    expect(mark).toHaveAttribute('data-off');
    act(() => {
      toggleBreakpoint('Main', 'a');
      useDebugMarks.setState({ held: new Map(), forced: new Map() });
    });
    expect(row).not.toHaveAttribute('data-held');
    expect(screen.queryByRole('img', { name: 'Breakpoint' })).toBeNull();
  });

  it('reveals its block at a press', () => {
    const row = open('a');
    expect(row).not.toHaveAttribute('data-disabled');
    fireEvent.click(row);
    expect(useProjectStore.getState()).toMatchObject({
      selection: ['a'],
      revealed: { tree: 'Main', node: 'a' },
    });
  });

  it('folds without revealing its block', async () => {
    expect(open('r', { hasChildren: true })).toHaveAttribute('aria-expanded', 'true');
    await user.click(screen.getByRole('button', { name: 'Fold Work' }));
    expect(nodeOf('Main', 'r')?.collapsed).toBe(true);
    expect(now.selection()).toEqual([]);
  });

  it('unfolds', async () => {
    expect(open('r', { hasChildren: true, isFolded: true })).toHaveAttribute('aria-expanded', 'false');
    act(() =>
      useProjectStore
        .getState()
        .apply('Main', 'fold', [(draft) => void (draft.nodes['r']!.collapsed = true)]),
    );
    await user.click(screen.getByRole('button', { name: 'Unfold Work' }));
    expect(nodeOf('Main', 'r')?.collapsed).toBeUndefined();
  });
});
