import { act, fireEvent, screen } from '@testing-library/react';
import { beforeEach, describe, expect, it } from 'vitest';
import type { NodeStatus, ServerMessage, TreeNode } from '@/generated/messages';
import { atPresent, useMoment } from '@/store/moment/store';
import { askWhy, useWhy } from '@/store/moment/why';
import { useProjectStore } from '@/store/project';
import { initialSession } from '@/store/session/reduce';
import { useSessionStore } from '@/store/session/store';
import { feedLastTick } from '@/store/session/trace/lastTick';
import { openDiagram } from '../../../harness/canvas';
import { show } from '../../../harness/testing';
import { WhySection } from './WhySection';

type Pair = readonly [number, NodeStatus];

const node = (uid: number, parent: number, type: string, node_id: string, path = type): TreeNode => ({
  ...{ uid, parent, type, node_id, path, tree_id: 'Main', kind: 'Control', name: type },
});
const nodes = [node(1, 0, 'Sequence', 'r'), node(2, 1, 'IsFree', 'c'), node(3, 1, 'Forward', 'f')];
const tick = (n: number, changed: readonly Pair[], flashed: readonly Pair[] = []) =>
  act(() => feedLastTick({ command: 'tick', data: { n, changed, flashed } } as unknown as ServerMessage));
const steps = () => screen.getAllByTestId('why-step').map(({ textContent }) => textContent);

beforeEach(() => {
  openDiagram({
    root: 'r',
    nodes: {
      r: { type: 'Sequence', children: ['c', 'f'] },
      c: { type: 'AlwaysSuccess' },
      f: { type: 'AlwaysSuccess' },
    },
  });
  useMoment.setState(atPresent);
  useSessionStore.setState({ ...initialSession, tree: nodes });
  useWhy.setState({ isOpen: true });
  feedLastTick({ command: 'tree', data: {} } as unknown as ServerMessage);
});

describe('why a block was ticked', () => {
  it('has its reasons from the root on, and follows the ticks', () => {
    show(<WhySection tree="Main" node="f" />);
    expect(screen.getByText('No tick of this tree is known yet.')).toBeVisible();
    tick(4, [
      [1, 'RUNNING'],
      [2, 'SUCCESS'],
      [3, 'RUNNING'],
    ]);
    expect(screen.getByTestId('why-question')).toHaveTextContent('Why is it RUNNING? (tick 4)');
    expect(steps()).toEqual([
      'Each tick begins at the root, “Sequence”. RUNNING',
      '“IsFree” returned SUCCESS, so “Forward” is ticked. RUNNING',
    ]);
    tick(
      5,
      [
        [1, 'IDLE'],
        [2, 'IDLE'],
        [3, 'IDLE'],
      ],
      [
        [3, 'FAILURE'],
        [1, 'FAILURE'],
      ],
    );
    expect(steps()[1]).toBe('“Forward” was RUNNING, so “Sequence” resumes it. FAILURE');
    tick(
      6,
      [],
      [
        [2, 'FAILURE'],
        [1, 'FAILURE'],
      ],
    );
    expect(steps()[1]).toBe('“IsFree” returned FAILURE, so “Sequence” ended before “Forward”. not ticked');
  });

  it('each line leads to its block', () => {
    show(<WhySection tree="Main" node="r" />);
    tick(1, [
      [1, 'RUNNING'],
      [2, 'RUNNING'],
    ]);
    fireEvent.click(screen.getByTestId('why-outcome'));
    expect(useProjectStore.getState().revealed).toMatchObject({ tree: 'Main', node: 'c' });
    expect(screen.getByTestId('why-outcome')).toHaveTextContent('“IsFree” returned RUNNING');
  });

  it('a halt explains nothing, and says so', () => {
    show(<WhySection tree="Main" node="f" />);
    tick(2, [[1, 'RUNNING']]);
    tick(2, [[1, 'IDLE']]);
    expect(screen.getByText(/was halted after this tick/)).toBeVisible();
    expect(screen.queryByTestId('why-step')).toBeNull();
  });

  it('a block of a tree that is called twice has a choice of the call', () => {
    useSessionStore.setState({ tree: [...nodes, node(4, 1, 'Forward', 'f', 'again/Forward')] });
    show(<WhySection tree="Main" node="f" />);
    tick(1, [
      [1, 'RUNNING'],
      [2, 'SUCCESS'],
      [3, 'RUNNING'],
    ]);
    fireEvent.change(screen.getByLabelText('Call of the subtree'), { target: { value: '1' } });
    expect(steps()[1]).toContain('“Forward” is RUNNING, so “Sequence” did not come to “Forward”.');
  });

  it('asking opens it and moves the focus there; a block that did not run has none', () => {
    useWhy.setState({ isOpen: false });
    show(<WhySection tree="Main" node="f" />);
    Element.prototype.scrollIntoView = () => undefined;
    act(askWhy);
    expect(screen.getByText('Why?')).toHaveFocus();
    expect(screen.getByTestId('why')).toHaveAttribute('open');
    show(<WhySection tree="Main" node="gone" />);
    expect(screen.getAllByTestId('why')).toHaveLength(1);
  });
});
