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
const tick = (
  n: number,
  changed: readonly Pair[],
  flashed: readonly Pair[] = [],
  forced: readonly number[] = [],
) =>
  act(() =>
    feedLastTick({ command: 'tick', data: { n, changed, flashed, forced } } as unknown as ServerMessage),
  );
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

  it('a result that was forced is said to be forced, and leads to its block', () => {
    show(<WhySection tree="Main" node="c" />);
    tick(
      1,
      [],
      [
        [2, 'FAILURE'],
        [1, 'FAILURE'],
      ],
      [2],
    );
    expect(steps()[1]).toBe(
      '“Sequence” begins with its first child, “IsFree”. FAILUREforced in the debugger',
    );
    const outcome = screen.getByTestId('why-outcome');
    expect(outcome).toHaveTextContent('“IsFree” is FAILURE because this was forced in the debugger.');
    fireEvent.click(outcome);
    expect(useProjectStore.getState().revealed).toMatchObject({ tree: 'Main', node: 'c' });
  });

  it('within a held tick it says what is ticked now, and explains the tick before', () => {
    show(<WhySection tree="Main" node="f" />);
    tick(4, [
      [1, 'RUNNING'],
      [2, 'SUCCESS'],
      [3, 'RUNNING'],
    ]);
    const hold = { uid: 3, path: [1, 3], tick: 5, statuses: [] };
    act(() => useSessionStore.setState({ executor: 'held', heldInPython: hold }));
    expect(screen.getByTestId('why-held')).toHaveTextContent('It is being ticked now');
    expect(screen.getByTestId('why-question')).toHaveTextContent('(tick 4)');
    act(() => useSessionStore.setState({ heldInPython: { ...hold, uid: 2, path: [1, 2] } }));
    expect(screen.getByTestId('why-held')).toHaveTextContent('The program is held within tick 5.');
    act(() => useSessionStore.setState({ heldInPython: null }));
    expect(screen.queryByTestId('why-held')).toBeNull();
  });

  it('after a halt it explains the tick before, and says that the tree was halted', () => {
    show(<WhySection tree="Main" node="f" />);
    tick(2, [
      [1, 'RUNNING'],
      [2, 'SUCCESS'],
      [3, 'RUNNING'],
    ]);
    const before = steps();
    tick(2, [
      [1, 'IDLE'],
      [2, 'IDLE'],
      [3, 'IDLE'],
    ]);
    expect(screen.getByText('The tree was halted after this tick.')).toBeVisible();
    expect(steps()).toEqual(before);
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
