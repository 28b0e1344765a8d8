import { MantineProvider } from '@mantine/core';
import { act, fireEvent, render, screen } from '@testing-library/react';
import userEvent from '@testing-library/user-event';
import { beforeEach, expect, it, vi } from 'vitest';
import '@/i18n';
import type { TreeNode } from '@/generated/messages';
import { emptyDiagram, type Diagram } from '@/model/diagram';
import { useLiveStore } from '@/store/project/live';
import { useProjectStore } from '@/store/project';
import { Canvas } from './Canvas';

/** Returns the session's description of a running node. */
function running(uid: number, tree_id: string, node_id: string): TreeNode {
  return { uid, parent: 0, type: '', kind: '', name: node_id, path: node_id, node_id, tree_id };
}

const rendered = vi.hoisted((): string[] => []);
const titles = vi.hoisted((): string[] => []);

// Every block asks for the tests that fail at it, exactly as often as it renders.
vi.mock('@/store/behaviourTests/failures', async (load) => ({
  ...(await load()),
  useFailuresOf: (key: string) => {
    rendered.push(key.replace('MainTree/', ''));
    return [];
  },
}));
vi.mock('./block/BlockTitle', () => ({
  BlockTitle: ({ id }: { id: string }) => {
    titles.push(id);
    return <span>{id}</span>;
  },
}));

const leaves = Array.from({ length: 12 }, (_, index) => `n${index}`);
const main: Diagram = {
  ...emptyDiagram('MainTree'),
  root: 'r',
  nodes: {
    r: { type: 'Sequence', children: [...leaves, 'wrong', 's'] },
    ...Object.fromEntries(leaves.map((id) => [id, { type: 'AlwaysSuccess' }])),
    wrong: { type: 'Sleep', ports: { msec: '{' } },
    s: { type: 'SubTree', tree: 'Dock' },
  },
};
const dock: Diagram = { ...emptyDiagram('Dock'), root: 'd', nodes: { d: { type: 'AlwaysFailure' } } };

beforeEach(() => {
  useProjectStore.getState().close();
  useLiveStore.getState().clear();
  for (const diagram of [dock, main])
    useProjectStore.getState().addFile(`trees/${diagram.id}.json`, JSON.stringify(diagram));
  useProjectStore.getState().setActiveTree('MainTree');
  render(
    <MantineProvider>
      <div style={{ width: 1000, height: 800 }}>
        <Canvas treeId="MainTree" />
      </div>
    </MantineProvider>,
  );
  rendered.length = 0;
  titles.length = 0;
});

it('paints the blocks whose status changed in a tick, and renders none', () => {
  const { setTree, setStatuses } = useLiveStore.getState();
  act(() => {
    setTree(leaves.map((id, uid) => running(uid, 'MainTree', id)));
  });
  act(() => {
    setStatuses([
      [3, 'RUNNING'],
      [7, 'SUCCESS'],
      [8, 'IDLE'],
    ]);
  });
  const statusOf = (id: string) => screen.getByTestId(`node-${id}`).dataset['status'];
  expect([statusOf('n3'), statusOf('n7'), statusOf('n8')]).toEqual(['RUNNING', 'SUCCESS', 'IDLE']);
  expect(rendered).toEqual([]);
  expect(titles).toEqual([]);
});

it('offers the fixes of a block', async () => {
  const user = userEvent.setup();
  const wrong = screen.getByTestId('node-wrong');
  fireEvent.click(wrong.querySelector('[data-testid=problem-mark]')!);
  const fix = screen.getByTestId('fix-box').querySelector('button')!;
  expect(fix).toHaveFocus();
  await user.keyboard('{Escape}');
  expect(screen.queryByTestId('fix-box')).toBeNull();
  fireEvent.click(wrong.querySelector('[data-testid=problem-mark]')!);
  await user.keyboard('{Enter}');
  expect(useProjectStore.getState().diagrams['MainTree']?.nodes['wrong']?.ports?.['msec']).toBe('{msec}');
  expect(screen.queryByTestId('fix-box')).toBeNull();
});

it('expands a subtree by a key, shows its live status, and changes nothing', () => {
  act(() => {
    useProjectStore.getState().select('MainTree', ['s']);
  });
  fireEvent.keyDown(screen.getByTestId('canvas'), { key: ' ' });
  expect(screen.getByTestId('node-s d')).toHaveAttribute('data-status', 'IDLE');
  const { setTree, setStatuses } = useLiveStore.getState();
  act(() => {
    setTree([running(1, 'Dock', 'd')]);
    setStatuses([[1, 'RUNNING']]);
  });
  expect(screen.getByTestId('node-s d')).toHaveAttribute('data-status', 'RUNNING');
  expect(useProjectStore.getState().diagrams['MainTree']).toEqual(main);
  fireEvent.keyDown(screen.getByTestId('canvas'), { key: ' ' });
  expect(screen.queryByTestId('node-s d')).toBeNull();
});

// This test comes last: after a drag, React Flow ignores clicks until the event loop has turned.
/** Fires a mouse event with its window, which jsdom does not accept as an argument here. */
function mouse(type: 'mousedown' | 'mousemove' | 'mouseup', target: Element | Window, x: number): void {
  const event = new MouseEvent(type, { clientX: x, clientY: 20, bubbles: true, cancelable: true });
  Object.defineProperty(event, 'view', { value: window });
  fireEvent(target, event);
}

it('renders at most three blocks for a step of a drag', () => {
  const block = screen.getByTestId('node-n3').closest<HTMLElement>('.react-flow__node')!;
  mouse('mousedown', block, 10);
  mouse('mousemove', window, 20);
  rendered.length = 0;
  let before = '';
  for (let x = 50; x <= 200; x += 30) {
    mouse('mousemove', window, x);
    // The canvas has no size in jsdom, so the block also moves while the pointer rests.
    expect(block.style.translate).not.toBe(before);
    before = block.style.translate;
    expect(rendered.splice(0).length).toBeLessThanOrEqual(3);
  }
  mouse('mouseup', window, 200);
  expect(block.style.translate).toBe('');
});
