import { act, screen } from '@testing-library/react';
import { beforeEach, describe, expect, it, onTestFinished, vi } from 'vitest';
import { trace } from '@/store/session/trace/trace';
import { runTree, treeNode } from '../../../harness/running';
import { show, user } from '../../../harness/testing';
import { RowButton } from './RowButton';

const row = { uid: 2, name: 'drive', type: 'Forward', depth: 2, node: 'n2', tree: 'Main' };
const onSelect = vi.fn();
const onFocus = vi.fn();

const showRow = (depth = 2, isTabStop = true) =>
  show(
    <RowButton
      row={{ ...row, depth }}
      index={3}
      top={66}
      isTabStop={isTabStop}
      onSelect={onSelect}
      onFocus={onFocus}
    />,
  );
const button = () => screen.getByRole('button');
const pass = (seconds: number) => act(() => vi.advanceTimersByTime(seconds * 1000));

beforeEach(() => {
  vi.useFakeTimers({ toFake: ['setInterval', 'clearInterval'] });
  onTestFinished(() => {
    vi.useRealTimers();
  });
  runTree([treeNode(1, 0, 'root'), treeNode(2, 1, 'drive')], { 1: [[2, 'RUNNING']] }, 3);
});

describe('RowButton', () => {
  it('has its past and present as text, and keeps them up to date', () => {
    showRow();
    expect(button()).toHaveAccessibleName('drive, Forward: running; ran once, for 2.0 s');
    trace.tick([[2, 'SUCCESS']], [], 4);
    trace.tick([[2, 'RUNNING']], [], 5);
    trace.advance(5.5);
    pass(0.9);
    expect(button()).toHaveAccessibleName(/2\.0 s/);
    pass(0.1);
    expect(button()).toHaveAccessibleName('drive, Forward: running; ran 2 times, for 3.5 s in all');
    trace.tick([[2, 'FAILURE']], [], 5.5);
    pass(1);
    expect(button()).toHaveAttribute('data-status', 'FAILURE');
    expect(button()).toHaveAccessibleName('drive, Forward: failure; ran 2 times, for 3.5 s in all');
  });

  it('follows the time that a node runs', () => {
    showRow();
    trace.advance(3.05);
    pass(1);
    expect(button()).toHaveAccessibleName(/for 2\.0 s/);
    trace.advance(3.2);
    pass(1);
    expect(button()).toHaveAccessibleName(/for 2\.2 s/);
  });

  it('is indented by its depth, within bounds, and is at its line', () => {
    const { unmount } = showRow();
    expect(button()).toHaveStyle({ paddingLeft: '34px', transform: 'translateY(66px)' });
    unmount();
    showRow(20);
    expect(button()).toHaveStyle({ paddingLeft: '106px' });
  });

  it('is one Tab stop, or none', () => {
    const { unmount } = showRow();
    expect(button()).toHaveAttribute('tabindex', '0');
    unmount();
    showRow(2, false);
    expect(button()).toHaveAttribute('tabindex', '-1');
  });

  it('reports the focus and the choice of its node', async () => {
    showRow();
    await user.click(button());
    expect(onSelect).toHaveBeenCalledWith(row);
    expect(onFocus).toHaveBeenCalledWith(3);
  });
});
