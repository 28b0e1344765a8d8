import { act, cleanup, fireEvent, screen } from '@testing-library/react';
import { beforeEach, describe, expect, it, vi } from 'vitest';
import { setEditor } from '@/store/project/editor';
import { useProjectStore } from '@/store/project';
import { now, openDiagram } from '../../../harness/canvas';
import { show, user } from '../../../harness/testing';
import { FindBar } from './FindBar';

const onClose = vi.fn();
const field = () => screen.getByLabelText('Find names, types, ports');
const count = () => document.querySelector('[aria-live]')!.textContent;
const button = (name: string) => screen.getByRole('button', { name });

beforeEach(() => {
  onClose.mockReset();
  openDiagram({
    root: 'r',
    nodes: {
      r: { type: 'Sequence', children: ['a', 'b', 'c'] },
      a: { type: 'Sleep' },
      b: { type: 'AlwaysSuccess', comment: 'no sleep' },
      c: { type: 'Sleep' },
    },
  });
  setEditor({ find: true });
  show(<FindBar treeId="Main" onClose={onClose} />);
});

describe('FindBar', () => {
  it('takes the focus, and shows no count yet', () => {
    expect(field()).toHaveFocus();
    expect(count()).toBe('');
  });

  it('shows the first match while the user types', async () => {
    await user.type(field(), 'sleep');
    expect(count()).toBe('1 of 3');
    expect(useProjectStore.getState().revealed).toMatchObject({ tree: 'Main', node: 'a' });
    expect(now.selection()).toEqual(['a']);
  });

  it('goes to the next match with Enter, and back with Shift', async () => {
    await user.type(field(), 'sleep{Enter}');
    expect(now.selection()).toEqual(['b']);
    expect(count()).toBe('2 of 3');
    await user.keyboard('{Enter}{Enter}');
    expect(now.selection()).toEqual(['a']);
    await user.keyboard('{Shift>}{Enter}{/Shift}');
    expect(now.selection()).toEqual(['c']);
    expect(count()).toBe('3 of 3');
  });

  it('goes to the matches with its buttons', async () => {
    await user.type(field(), 'sleep');
    await user.click(button('Next'));
    expect(now.selection()).toEqual(['b']);
    await user.click(button('Previous'));
    await user.click(button('Previous'));
    expect(now.selection()).toEqual(['c']);
  });

  it('starts again with another text', async () => {
    await user.type(field(), 'sleep{Enter}');
    await user.type(field(), '{Backspace}');
    expect(count()).toBe('1 of 3');
    expect(now.selection()).toEqual(['a']);
  });

  it('leaves the selection unchanged if it finds nothing', async () => {
    await user.type(field(), 'sleep');
    await user.type(field(), 'zz{Enter}');
    expect(count()).toBe('0 of 0');
    expect(now.selection()).toEqual(['a']);
  });

  it('marks in the whole of a tree while the user types, and goes there with Enter', async () => {
    cleanup();
    const onFound = vi.fn();
    show(<FindBar treeId="Main" onClose={onClose} isWhole onFound={onFound} />);
    await user.type(field(), 'sleep');
    expect(onFound).toHaveBeenLastCalledWith(['a', 'b', 'c']);
    expect(now.selection()).toEqual([]);
    await user.keyboard('{Enter}');
    expect(now.selection()).toEqual(['a']);
  });

  it('closes with Escape and its button', async () => {
    await user.keyboard('{Escape}');
    expect(now.editor().find).toBe(false);
    expect(onClose).toHaveBeenCalledOnce();
    act(() => setEditor({ find: true }));
    await user.click(button('Close'));
    expect(now.editor().find).toBe(false);
    expect(onClose).toHaveBeenCalledTimes(2);
  });

  it('keeps its keys from reaching the canvas', () => {
    const onKey = vi.fn();
    document.addEventListener('keydown', onKey);
    fireEvent.keyDown(field(), { key: 'Delete' });
    document.removeEventListener('keydown', onKey);
    expect(onKey).not.toHaveBeenCalled();
  });
});
