import { act, screen } from '@testing-library/react';
import { describe, expect, it, onTestFinished, vi } from 'vitest';
import { trace } from '@/store/session/trace/trace';
import { runTree, treeNode } from '../../../harness/running';
import { show } from '../../../harness/testing';
import { NodeStatistics } from './NodeStatistics';

const shown = () =>
  Object.fromEntries(
    [...screen.getByTestId('node-statistics').querySelectorAll('[data-key]')].map((row) => [
      row.querySelector('dt')?.textContent,
      row.querySelector('dd')?.textContent,
    ]),
  );

function fakeClock(): void {
  vi.useFakeTimers({ toFake: ['setInterval', 'clearInterval'] });
  onTestFinished(() => {
    vi.useRealTimers();
  });
}

describe('NodeStatistics', () => {
  it('counts the runs and results of a block', () => {
    runTree(
      [treeNode(1, 0, 'root')],
      { 1: [[1, 'RUNNING']], 3: [[1, 'SUCCESS']], 4: [[1, 'RUNNING']], 5: [[1, 'FAILURE']] },
      7,
    );
    show(<NodeStatistics tree="Main" node="n1" />);
    expect(screen.getByRole('region', { name: 'This run' })).toBeInTheDocument();
    expect(shown()).toEqual({
      Now: 'failure',
      'Times it ran': '2',
      'Mean time': '1.50 s',
      'Became success': '1',
      'Became failure': '1',
    });
  });

  it('adds up the instances of a block, and shows the status of the one that is active', () => {
    const twice = [treeNode(1, 0, 'a'), treeNode(2, 0, 'b', { node_id: 'n1' })];
    runTree(twice, { 1: [[1, 'RUNNING']], 3: [[1, 'IDLE']], 4: [[2, 'RUNNING']] }, 10);
    show(<NodeStatistics tree="Main" node="n1" />);
    expect(shown()).toMatchObject({ Now: 'running', 'Times it ran': '2', 'Mean time': '4.00 s' });
  });

  it('has no mean time before the first run', () => {
    runTree([treeNode(1, 0, 'root')], {}, 7);
    show(<NodeStatistics tree="Main" node="n1" />);
    expect(shown()).toEqual({
      Now: 'idle',
      'Times it ran': '0',
      'Mean time': '—',
      'Became success': '0',
      'Became failure': '0',
    });
  });

  it('shows nothing for a block that does not run', () => {
    runTree([treeNode(1, 0, 'root'), treeNode(2, 1, 'x', { tree_id: 'Other' })], {}, 7);
    show(<NodeStatistics tree="Main" node="n2" />);
    expect(screen.queryByTestId('node-statistics')).toBeNull();
  });

  it('is updated twice a second', () => {
    fakeClock();
    runTree([treeNode(1, 0, 'root')], {}, 7);
    show(<NodeStatistics tree="Main" node="n1" />);
    trace.tick([[1, 'RUNNING']], [], 8);
    act(() => vi.advanceTimersByTime(499));
    expect(shown()).toMatchObject({ Now: 'idle' });
    act(() => vi.advanceTimersByTime(1));
    expect(shown()).toMatchObject({ Now: 'running', 'Times it ran': '1' });
  });
});
