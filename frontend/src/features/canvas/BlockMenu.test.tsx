import { screen } from '@testing-library/react';
import { beforeEach, describe, expect, it, vi } from 'vitest';
import { useProjectStore } from '@/store/project';
import { oneBlock } from '@/store/testing';
import { now, openDiagram } from '../../../harness/canvas';
import { nodeOf, show, user } from '../../../harness/testing';
import { BlockMenu, type MenuPoint } from './BlockMenu';

beforeEach(() => {
  openDiagram(
    {
      root: 'r',
      nodes: {
        r: { type: 'Sequence', children: ['a', 'i', 's'] },
        a: { type: 'Sleep', ports: { msec: '5' } },
        i: { type: 'Inverter', children: ['x'] },
        x: { type: 'AlwaysSuccess' },
        s: { type: 'SubTree', tree: 'Dock' },
      },
    },
    { texts: { 'trees/Dock.json': oneBlock('Dock', 'AlwaysSuccess') } },
  );
});

function open(selected: readonly string[], point: Partial<MenuPoint> = {}) {
  const onClose = vi.fn();
  useProjectStore.getState().select('Main', selected);
  show(<BlockMenu point={{ x: 30, y: 40, isOnBlock: true, ...point }} onClose={onClose} />);
  return onClose;
}

/** Returns the labels of the menu's items, one list for each group. */
function groups(): string[][] {
  const menu = screen.getByRole('menu');
  const found: string[][] = [[]];
  for (const each of menu.querySelectorAll('[role=menuitem], [class*=Menu-divider]')) {
    if (each.matches('[role=menuitem]')) found.at(-1)!.push(each.getAttribute('data-testid')!.slice(5));
    else found.push([]);
  }
  return found;
}

const COMMON = [
  ['rename', 'comment', 'disable'],
  ['breakpoint'],
  ['cut', 'copy', 'paste', 'duplicate'],
  ['delete'],
];

describe('BlockMenu', () => {
  it('is closed without a point', () => {
    show(<BlockMenu point={null} onClose={() => undefined} />);
    expect(screen.queryByRole('menu')).toBeNull();
  });

  it('has the commands for a leaf', () => {
    open(['a']);
    const menu = screen.getByRole('menu', { name: 'Commands on the block' });
    expect(menu.querySelector('[role=presentation][tabindex]')).toBeNull();
    expect(groups()).toEqual([['addAfter', 'wrap', 'morph'], ...COMMON]);
  });

  it('has the commands for a decorator', () => {
    open(['i']);
    expect(groups()).toEqual([
      ['addAfter', 'wrap', 'unwrap', 'morph', 'extract'],
      ['rename', 'comment', 'disable', 'fold'],
      ...COMMON.slice(1),
    ]);
  });

  it('has the commands for a subtree', () => {
    open(['s']);
    expect(groups()).toEqual([
      ['lookInside'],
      ['openTree'],
      ['addAfter', 'wrap', 'morph', 'inline'],
      ...COMMON,
    ]);
  });

  it('has the commands for several blocks', () => {
    open(['a', 'i']);
    expect(groups()).toEqual([
      ['wrap', 'wrapSequence', 'wrapFallback', 'extract'],
      ['disable'],
      ['breakpoint'],
      ['cut', 'copy', 'paste', 'duplicate'],
      ['delete'],
    ]);
  });

  it('does not extract blocks that are not consecutive', () => {
    open(['a', 's']);
    expect(groups()[0]).toEqual(['wrap', 'wrapSequence', 'wrapFallback']);
  });

  it('adds and pastes on the empty canvas', () => {
    open([], { isOnBlock: false });
    expect(groups()).toEqual([
      ['addBlock', 'paste'],
      ['collapse1', 'collapse2', 'collapse3', 'collapse4'],
    ]);
  });

  it('shows the names and the keys of the commands', () => {
    open(['a']);
    expect(screen.getByTestId('menu-wrap')).toHaveTextContent('Wrap in…Ctrl+G');
    expect(screen.getByTestId('menu-delete')).toHaveTextContent('DeleteDel');
    expect(screen.getByTestId('menu-comment')).toHaveTextContent('Comment/');
  });

  it('colours the commands that remove something', () => {
    open(['a']);
    const color = (id: string) => screen.getByTestId(id).style.getPropertyValue('--menu-item-color');
    expect(color('menu-delete')).toContain('failure');
    expect(color('menu-duplicate')).not.toContain('failure');
  });

  it('runs the chosen command, and closes', async () => {
    const onClose = open(['a']);
    await user.click(screen.getByTestId('menu-disable'));
    expect(nodeOf('Main', 'a')?.disabled).toBe(true);
    expect(onClose).toHaveBeenCalled();
  });

  it('opens the quick-add box', async () => {
    open(['a']);
    await user.click(screen.getByTestId('menu-morph'));
    expect(now.editor().quickAdd?.goal).toEqual({ does: 'morph', node: 'a' });
  });

  it('opens at its point', () => {
    open(['a']);
    expect(document.querySelector('span[style*="fixed"]')).toHaveStyle({ left: '30px', top: '40px' });
  });
});
