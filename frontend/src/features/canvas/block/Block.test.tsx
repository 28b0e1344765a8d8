import { act, fireEvent, screen, within } from '@testing-library/react';
import { Position, type NodeProps } from '@xyflow/react';
import { beforeEach, describe, expect, it } from 'vitest';
import type { NodeStatus } from '@/generated/messages';
import { vocabulary } from '@/model/testing';
import type { TestReport } from '@/api/types';
import { useCoverage } from '@/store/behaviourTests/coverage';
import { useTests } from '@/store/behaviourTests/report';
import { useProjectStore } from '@/store/project';
import { setEditor } from '@/store/project/editor';
import { useLiveStore } from '@/store/project/live';
import type { ShownProblem } from '@/store/project/problems';
import { now, openDiagram, showInFlow } from '../../../../harness/canvas';
import { nodeOf, user } from '../../../../harness/testing';
import type { BlockData, BlockNode } from '../flow';
import { Block } from './Block';

const problem: ShownProblem = {
  source: 'server',
  severity: 'warning',
  node: 'a',
  code: '',
  message: 'It is odd.',
  hint: '',
};

beforeEach(() => {
  openDiagram({
    root: 'a',
    nodes: { a: { type: 'Sequence', collapsed: true, children: ['x'] }, x: { type: 'Sleep' } },
  });
});

function open(data: Partial<BlockData> = {}, more: Partial<NodeProps<BlockNode>> = {}) {
  const props = {
    id: 'a',
    selected: false,
    width: 140,
    height: 66,
    ...more,
    data: {
      tree: 'Main',
      node: { type: 'Sequence' },
      spec: vocabulary.specs.get('Sequence'),
      problem: null,
      isDraft: false,
      isHorizontal: false,
      canGrow: false,
      folded: 0,
      look: null,
      inside: null,
      ...data,
    },
  };
  showInFlow(<Block {...(props as NodeProps<BlockNode>)} />);
  return screen.getByTestId('node-a');
}

const live = (statuses: Record<string, NodeStatus>, faults: Record<string, string> = {}) =>
  act(() =>
    useLiveStore.setState({
      statuses: new Map(Object.entries(statuses)),
      faults: new Map(Object.entries(faults)),
    }),
  );
const marks = (block: HTMLElement) =>
  [...block.querySelectorAll<HTMLElement>('span[data-status]')].map(({ dataset }) => dataset['status']);

describe('Block', () => {
  it('shows the state of the block, and nothing else', () => {
    const block = open();
    expect({ ...block.dataset }).toEqual({
      testid: 'node-a',
      type: 'Sequence',
      family: 'control',
      status: 'IDLE',
    });
    expect(block.className).not.toMatch(/horizontal/);
    expect(screen.queryByTestId('problem-mark')).toBeNull();
    expect(screen.queryByTestId('look-a')).toBeNull();
    expect(screen.queryByRole('button')).toBeNull();
  });

  it('shows that it is selected, disabled, a draft, or of an unknown type', () => {
    const node = { type: 'Nowhere', disabled: true, color: '#123456' };
    const block = open({ node, spec: undefined, isDraft: true }, { selected: true });
    expect(block.dataset).toMatchObject({
      family: 'unknown',
      selected: 'true',
      disabled: 'true',
      draft: 'true',
    });
    expect(block.style.getPropertyValue('--family')).toBe('#123456');
  });

  it('is highlighted as the target of a dragged block', () => {
    const block = open();
    const mark = { x: 0, y: 0, width: 1, height: 1 };
    act(() => setEditor({ slot: { parent: 'a', index: 0, kind: 'onto', mark } }));
    expect(block.dataset['target']).toBe('true');
    act(() => setEditor({ slot: { parent: 'a', index: 0, kind: 'between', mark } }));
    expect(block.dataset['target']).toBeUndefined();
    act(() => setEditor({ slot: { parent: 'x', index: 0, kind: 'onto', mark } }));
    expect(block.dataset['target']).toBeUndefined();
  });

  it('shows its status in the run, and not that of a block with the same id in another tree', () => {
    const block = open();
    live({ 'Main/a': 'RUNNING', 'Dock/a': 'FAILURE' });
    expect(block.dataset['status']).toBe('RUNNING');
    expect(marks(block)).toEqual(['RUNNING']);
    live({ 'Dock/a': 'FAILURE' });
    expect(block.dataset['status']).toBe('IDLE');
    expect(marks(block)).toEqual([]);
  });

  it('shows the status of its own instance inside of a subtree', () => {
    const block = open({ inside: { tree: 'Dock', node: 'd' } });
    live({ 'Dock/d': 'SUCCESS', 'Main/a': 'RUNNING' });
    expect(block.dataset).toMatchObject({ status: 'SUCCESS', inside: '' });
  });

  it('shows a problem; a press selects the block and opens the fixes', async () => {
    const block = open({ problem });
    expect(block.dataset['problem']).toBe('warning');
    await user.click(screen.getByTestId('problem-mark'));
    expect(now.selection()).toEqual(['a']);
    expect(now.editor().fixing).toBe('a');
  });

  it('shows the fault of the run instead of a problem, as a failure', async () => {
    const block = open({ problem });
    live({ 'Main/a': 'SUCCESS' }, { 'Main/a': 'It broke.' });
    expect(block.dataset['fault']).toBe('');
    expect(marks(block)).toEqual(['FAILURE']);
    expect(screen.getAllByTestId('problem-mark')).toHaveLength(1);
    expect(screen.getByTestId('problem-mark')).toHaveAccessibleName(/It broke/);
    await user.click(screen.getByTestId('problem-mark'));
    expect(now.editor().fixing).toBe('a');
  });

  it('opens no fixes for a fault inside of a subtree', () => {
    open({ inside: { tree: 'Dock', node: 'd' } });
    live({}, { 'Dock/d': 'It broke.' });
    expect(screen.queryByTestId('problem-mark')).toBeNull();
    expect(screen.getByRole('img', { name: /It broke/ })).toBeInTheDocument();
  });

  it('expands its tree, and collapses it', async () => {
    open({ look: 'closed' });
    const look = screen.getByTestId('look-a');
    expect(look).toHaveAttribute('aria-expanded', 'false');
    expect(look).toHaveAttribute('title', 'Look inside without leaving this tree (Space)');
    expect(look).toHaveTextContent('inside');
    await user.click(look);
    expect(now.editor().expanded['Main']).toEqual(new Set(['a']));
  });

  it('shows that its tree is expanded', () => {
    open({ look: 'open' });
    expect(screen.getByTestId('look-a')).toHaveAttribute('aria-expanded', 'true');
    expect(screen.getByTestId('look-a')).toHaveAttribute('title', 'Close the view inside (Space)');
  });

  it('counts the blocks that it hides, and unfolds at a press', async () => {
    open({ folded: 1 });
    const fold = screen.getByRole('button', { name: '1 block' });
    expect(fold).toBeEnabled();
    await user.click(fold);
    expect(nodeOf('Main', 'a')?.collapsed).toBeUndefined();
  });

  it('stays folded inside of a subtree', () => {
    open({ folded: 2, inside: { tree: 'Dock', node: 'd' } });
    expect(screen.getByRole('button', { name: '2 blocks' })).toBeDisabled();
  });
});

describe('the ends of connections', () => {
  const handle = (block: HTMLElement, type: string) =>
    block.querySelector<HTMLElement>(`.react-flow__handle.${type}`)!;

  it('are above and below, or left and right', () => {
    const block = open();
    expect(handle(block, 'target')).toHaveAttribute('data-handlepos', Position.Top);
    expect(handle(block, 'source')).toHaveAttribute('data-handlepos', Position.Bottom);
  });

  it('are left and right in a left-right tree', () => {
    const block = open({ isHorizontal: true });
    expect(block.className).toMatch(/horizontal/);
    expect(handle(block, 'target')).toHaveAttribute('data-handlepos', Position.Left);
    expect(handle(block, 'source')).toHaveAttribute('data-handlepos', Position.Right);
  });

  it('add a child if there is room for one', () => {
    const block = open({ canGrow: true });
    const source = handle(block, 'source');
    expect(source).toHaveAttribute('title', 'Click to add a child, drag to connect');
    expect(source).toBeVisible();
    expect(source.className).toMatch(/plus/);
    expect(source.querySelector('svg')).not.toBeNull();
    fireEvent.click(source, { clientX: 5, clientY: 6 });
    expect(now.editor().quickAdd).toMatchObject({
      tree: 'Main',
      goal: { does: 'add', place: { at: 'child', parent: 'a', index: 1 } },
      x: 5,
      y: 6,
    });
  });

  it.each([{ canGrow: false }, { canGrow: true, folded: 1 }])('add none to a block with %o', (data) => {
    const source = handle(open(data), 'source');
    expect(source).not.toBeVisible();
    expect(source).not.toHaveAttribute('title');
    expect(source.className).not.toMatch(/plus/);
    expect(source.querySelector('svg')).toBeNull();
  });
});

describe('tests', () => {
  it('shows what the tests cover of it, and where they failed', () => {
    const block = open();
    expect(screen.queryByTestId('coverage-mark')).toBeNull();
    act(() =>
      useCoverage.setState({
        blocks: new Map([['Main/a', { level: 'never', missing: ['ticked'], items: 1 }]]),
      }),
    );
    expect(within(block).getByTestId('coverage-mark')).toHaveAttribute('data-level', 'never');
    const failure = { tree: 'Main', node_id: 'a', line: 1, tick: 1, wanted: 'A', got: 'B' };
    const report = { tests: [{ name: 'x', file: 'f', failures: [failure] }] } as unknown as TestReport;
    act(() => useTests.setState({ project: useProjectStore.getState().projectId, report }));
    expect(within(block).getByTestId('failure-mark')).toBeVisible();
    act(() => {
      useTests.setState(useTests.getInitialState(), true);
      useCoverage.setState(useCoverage.getInitialState(), true);
    });
  });
});
