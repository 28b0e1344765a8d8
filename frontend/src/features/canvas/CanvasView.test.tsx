import { act, fireEvent, screen, waitFor } from '@testing-library/react';
import type { ReactFlowState } from '@xyflow/react';
import { beforeEach, describe, expect, it, onTestFinished, vi } from 'vitest';
import { childrenOf, emptyDiagram, type Diagram } from '@/model/diagram';
import { removeSubtrees } from '@/model/edits';
import { setEditor, toggleExpanded } from '@/store/project/editor';
import { useProjectStore } from '@/store/project';
import { useSessionStore } from '@/store/session/store';
import { oneBlock } from '@/store/testing';
import { now, openDiagram, showDrawn } from '../../../harness/canvas';
import { nodeOf, watchNavigation } from '../../../harness/testing';
import { CanvasView } from './CanvasView';

const main: Diagram = {
  ...emptyDiagram('Main'),
  root: 'r',
  nodes: {
    r: { type: 'Sequence', children: ['a', 'b', 's'] },
    a: { type: 'Sleep', ports: { msec: '{' } },
    b: { type: 'Fallback', children: [] },
    s: { type: 'SubTree', tree: 'Dock' },
  },
};
const store = () => useProjectStore.getState();
const canvas = () => screen.getByTestId('canvas');
const block = (id: string) => screen.getByTestId(`node-${id}`);
const edge = (id: string) => document.querySelector<SVGElement>(`.react-flow__edge[data-id="${id}"]`)!;
/** The commands in the menu of the empty canvas. */
const FREE = ['addBlock', 'paste', 'collapse1', 'collapse2', 'collapse3', 'collapse4'];
const pane = () => document.querySelector<HTMLElement>('.react-flow__pane')!;
const select = (...ids: string[]) => act(() => store().select('Main', ids));
const items = () => screen.queryAllByRole('menuitem').map((item) => item.dataset['testid']?.slice(5));

function open(more: Partial<Diagram> = {}) {
  openDiagram({ ...main, ...more }, { texts: { 'trees/Dock.json': oneBlock('Dock', 'AlwaysSuccess') } });
  return showDrawn(<CanvasView treeId="Main" />);
}

beforeEach(() => {
  // jsdom has no layout, so every element in the page counts as visible.
  Element.prototype.checkVisibility = () => true;
});

describe('the canvas', () => {
  it('draws every block and every connection', () => {
    open();
    expect(['r', 'a', 'b', 's'].map((id) => block(id).dataset['type'])).toEqual([
      'Sequence',
      'Sleep',
      'Fallback',
      'SubTree',
    ]);
    expect(['a', 'b', 's'].filter(edge)).toHaveLength(3);
    expect(canvas()).toHaveAttribute('data-tree', 'Main');
    expect(canvas()).toHaveAttribute('tabindex', '0');
    expect(screen.getByRole('application', { name: /^Behaviour tree Main/ })).toBe(canvas());
    expect(canvas()).toHaveAttribute('aria-describedby', 'canvas-announcer');
    expect(screen.queryByTestId('ghost-block')).toBeNull();
  });

  it('rests while the run is paused: nothing moves on it then', () => {
    open();
    expect(canvas()).not.toHaveAttribute('data-paused');
    act(() => useSessionStore.setState({ executor: 'paused' }));
    expect(canvas()).toHaveAttribute('data-paused', 'true');
    act(() => useSessionStore.setState({ executor: 'application_running' }));
    expect(canvas()).not.toHaveAttribute('data-paused');
  });

  it('leaves out details when zoomed out', () => {
    const { store: flow } = open();
    expect(canvas()).not.toHaveAttribute('data-names');
    act(() => flow.setState({ transform: [0, 0, 0.43] }));
    expect(canvas()).toHaveAttribute('data-names', 'true');
    expect(canvas()).not.toHaveAttribute('data-far');
    act(() => flow.setState({ transform: [0, 0, 0.41] }));
    expect(canvas()).toHaveAttribute('data-far', 'true');
    expect(canvas()).not.toHaveAttribute('data-names');
  });

  it('explains how to start an empty tree', () => {
    open({ root: null, nodes: {} });
    expect(screen.getByTestId('ghost-block')).toBeInTheDocument();
  });

  it('shows the overview if the user has switched it on', () => {
    open();
    expect(screen.queryByTestId('minimap')).toBeNull();
    act(() => setEditor({ minimap: true }));
    expect(screen.getByTestId('minimap')).toBeInTheDocument();
  });

  it('announces the selected block to screen readers', () => {
    open();
    select('a');
    expect(document.getElementById('canvas-announcer')).toHaveTextContent(/^Sleep, Sleep, child 1 of 3/);
  });
});

describe('a press', () => {
  it('on a block selects it, and with Ctrl one more', () => {
    open();
    fireEvent.click(block('a'));
    expect(now.selection()).toEqual(['a']);
    expect(block('a').dataset['selected']).toBe('true');
    fireEvent.keyDown(document, { key: 'Control', ctrlKey: true });
    fireEvent.click(block('b'), { ctrlKey: true });
    fireEvent.keyUp(document, { key: 'Control' });
    expect(now.selection()).toEqual(['a', 'b']);
    fireEvent.click(pane());
    expect(now.selection()).toEqual([]);
  });

  it('on one of several selected blocks selects it alone, unless a modifier key is held', () => {
    open();
    for (const keys of [{ shiftKey: true }, { ctrlKey: true }, { metaKey: true }]) {
      select('a', 'b');
      fireEvent.click(block('b'), keys);
      expect(now.selection()).toEqual(['a', 'b']);
    }
    fireEvent.click(block('b'));
    expect(now.selection()).toEqual(['b']);
  });

  it('starts a new selection if another tree was in front', () => {
    open();
    act(() => store().select('Dock', ['n1']));
    fireEvent.click(block('a'));
    expect(store().activeTree).toBe('Main');
    expect(now.selection()).toEqual(['a']);
  });

  it('gives the canvas the focus, and puts its tree in front', () => {
    open();
    act(() => store().setActiveTree('Dock'));
    fireEvent.pointerDown(pane());
    expect(canvas()).toHaveFocus();
    expect(store().activeTree).toBe('Main');
  });

  it('on a tool or a breadcrumb leaves the focus on the blocks', () => {
    open();
    for (const place of ['Show the tools of the view', 'Main']) {
      (document.activeElement as HTMLElement).blur();
      const button = screen.getByRole('button', { name: place });
      fireEvent.pointerDown(button);
      expect(canvas()).toHaveFocus();
      // False: the default action, which moves the focus, was prevented.
      expect(fireEvent.mouseDown(button)).toBe(false);
    }
    expect(fireEvent.mouseDown(canvas())).toBe(true);
  });

  it('on a field leaves the focus there', () => {
    open();
    act(() => setEditor({ editing: { node: 'a', field: 'name' } }));
    const field = screen.getByRole('textbox', { name: 'Name' });
    fireEvent.pointerDown(field);
    expect(field).toHaveFocus();
  });
});

describe('a connection', () => {
  it.each(['Delete', 'Backspace'])('is removed by %s when it was pressed', (key) => {
    open();
    fireEvent.click(edge('b'));
    expect(edge('b').querySelector('[data-selected]')).not.toBeNull();
    expect(edge('a').querySelector('[data-selected]')).toBeNull();
    expect(fireEvent.keyDown(canvas(), { key })).toBe(false);
    expect(childrenOf(now.diagram(), 'r')).toEqual(['a', 's']);
    expect(now.diagram().drafts).toEqual(['b']);
  });

  it('stays when blocks are selected, or another connection is pressed', () => {
    open();
    fireEvent.click(edge('b'));
    select('a');
    expect(edge('b').querySelector('[data-selected]')).toBeNull();
    fireEvent.keyDown(canvas(), { key: 'Delete' });
    expect(childrenOf(now.diagram(), 'r')).toEqual(['b', 's']);
  });

  it('is deselected when another one is pressed', () => {
    open();
    fireEvent.click(edge('a'));
    fireEvent.click(edge('b'));
    expect(document.querySelectorAll('g[data-selected]')).toHaveLength(1);
    expect(edge('b').querySelector('[data-selected]')).not.toBeNull();
    fireEvent.click(pane());
    expect(document.querySelector('g[data-selected]')).toBeNull();
  });

  it('is not removed by another key', () => {
    open();
    fireEvent.click(edge('b'));
    fireEvent.keyDown(canvas(), { key: 'Home' });
    expect(childrenOf(now.diagram(), 'r')).toEqual(['a', 'b', 's']);
    expect(now.selection()).toEqual(['r']);
  });
});

describe('the menu', () => {
  it('of a block selects it', async () => {
    open();
    expect(fireEvent.contextMenu(block('a'))).toBe(false);
    expect(now.selection()).toEqual(['a']);
    expect(items()).toContain('wrap');
    fireEvent.keyDown(screen.getByRole('menu'), { key: 'Escape' });
    await waitFor(() => expect(screen.queryByRole('menu')).toBeNull());
    expect(canvas()).toHaveFocus();
  });

  it('of one of several keeps them all selected', () => {
    open();
    select('b', 'a');
    fireEvent.contextMenu(block('a'));
    expect(now.selection()).toEqual(['b', 'a']);
    expect(items()).toContain('extract');
  });

  it('of the empty canvas adds and pastes', () => {
    open();
    fireEvent.contextMenu(pane());
    expect(items()).toEqual(FREE);
  });

  it('opens by keys, for the selection or the canvas', async () => {
    open();
    expect(fireEvent.keyDown(canvas(), { key: 'F10', shiftKey: true })).toBe(false);
    await waitFor(() => expect(items()).toEqual(FREE));
    select('a');
    fireEvent.keyDown(canvas(), { key: 'ContextMenu' });
    await waitFor(() => expect(items()).toContain('wrap'));
  });

  it('is that of a button while the button has the focus', () => {
    open();
    const button = screen.getByRole('button', { name: 'Show the tools of the view' });
    expect(fireEvent.keyDown(button, { key: 'ContextMenu' })).toBe(true);
    expect(fireEvent.contextMenu(canvas())).toBe(false);
    expect(fireEvent.contextMenu(button)).toBe(true);
  });

  it('does not open inside of a subtree', () => {
    open();
    act(() => toggleExpanded('Main', 's'));
    fireEvent.contextMenu(block('s n1'));
    expect(items()).toEqual([]);
    expect(now.selection()).toEqual([]);
  });
});

describe('a double click', () => {
  it('on a block opens its document', () => {
    const { openTree } = watchNavigation();
    open();
    fireEvent.doubleClick(block('s'));
    expect(openTree).toHaveBeenCalledWith('Dock');
    fireEvent.doubleClick(block('a'));
    expect(now.editor().editing).toEqual({ node: 'a', field: 'name' });
  });

  it('inside of a subtree opens that tree', () => {
    watchNavigation();
    open();
    act(() => toggleExpanded('Main', 's'));
    fireEvent.doubleClick(block('s n1'));
    expect(store().revealed).toMatchObject({ tree: 'Dock', node: 'n1' });
  });

  it('on the empty canvas opens the quick-add box there', () => {
    const { store: flow } = open();
    act(() => flow.setState({ transform: [100, 50, 2] }));
    fireEvent.doubleClick(pane(), { clientX: 301, clientY: 90 });
    expect(now.editor().quickAdd).toEqual({
      tree: 'Main',
      goal: { does: 'add', place: { at: 'draft', position: [101, 20] } },
      x: 301,
      y: 90,
      text: '',
    });
  });

  it('on an empty tree opens the quick-add box for the first block', () => {
    open();
    act(() => store().apply('Main', 'delete', [removeSubtrees(['r'])]));
    fireEvent.doubleClick(pane());
    expect(now.editor().quickAdd?.goal).toEqual({ does: 'add', place: { at: 'root' } });
  });
});

describe('a box over the canvas', () => {
  it('adds a block, and returns the focus', () => {
    open();
    select('b');
    fireEvent.keyDown(canvas(), { key: 'Tab' });
    expect(screen.getByTestId('quick-add')).toBeInTheDocument();
    fireEvent.keyDown(screen.getByRole('combobox'), { key: 'Escape' });
    expect(screen.queryByTestId('quick-add')).toBeNull();
    expect(canvas()).toHaveFocus();
  });

  it('belongs to another tree that is drawn there', () => {
    open();
    act(() =>
      setEditor({ quickAdd: { tree: 'Dock', goal: { does: 'wrap', nodes: [] }, x: 0, y: 0, text: '' } }),
    );
    expect(screen.queryByTestId('quick-add')).toBeNull();
  });

  it('finds blocks', () => {
    open();
    act(() => setEditor({ find: true }));
    fireEvent.keyDown(screen.getByRole('search').querySelector('input')!, { key: 'Escape' });
    expect(screen.queryByRole('search')).toBeNull();
    expect(canvas()).toHaveFocus();
  });

  it('has the fixes of the selected block only', () => {
    open();
    select('a');
    act(() => setEditor({ fixing: 'a' }));
    fireEvent.keyDown(screen.getByTestId('fix-box'), { key: 'Escape' });
    expect(now.editor().fixing).toBeNull();
    expect(canvas()).toHaveFocus();
    act(() => setEditor({ fixing: 'a' }));
    select('b');
    expect(screen.queryByTestId('fix-box')).toBeNull();
  });
});

it('accepts a block from the palette', () => {
  open();
  act(() => setEditor({ dragged: { type: 'Sleep' } }));
  const dataTransfer = { dropEffect: '' };
  fireEvent.dragOver(pane(), { dataTransfer, clientX: 9000, clientY: 9000 });
  fireEvent.drop(pane(), { dataTransfer, clientX: 9000, clientY: 9000 });
  const [made] = now.diagram().drafts;
  expect(nodeOf('Main', made!)?.type).toBe('Sleep');
});

it('draws only the visible part of a large tree', () => {
  const ids = Array.from({ length: 151 }, (_, at) => `n${at}`);
  const leaves = Object.fromEntries(ids.map((id) => [id, { type: 'Sleep' }]));
  open({ nodes: { r: { type: 'Sequence', children: ids }, ...leaves } });
  expect(screen.queryAllByTestId(/^node-n/).length).toBeLessThan(100);
});

it('scrolls to a block on request', async () => {
  const { view, store: flow } = open();
  // A canvas without a size waits until it has one.
  const size = vi.spyOn(Element.prototype, 'clientWidth', 'get').mockReturnValue(800);
  onTestFinished(() => size.mockRestore());
  // This replaces the view that React Flow has made.
  act(() => flow.setState({ panZoom: view as unknown as ReactFlowState['panZoom'] }));
  act(() => store().reveal('Main', 'b'));
  await waitFor(() => expect(view.setViewport).toHaveBeenCalled());
  expect(now.selection()).toEqual(['b']);
  onTestFinished(() => store().select('Main', []));
});

describe('a tree that does not fit', () => {
  const leaves = Array.from({ length: 150 }, (_, at) => `n${at}`);
  const large = {
    root: 'r',
    nodes: {
      r: { type: 'Sequence', children: ['a', ...leaves] },
      a: { type: 'Sleep' },
      ...Object.fromEntries(leaves.map((id) => [id, { type: 'Sleep' }])),
    },
  };

  it('is drawn as a whole when it is seen from far, and Enter goes to the selected block', async () => {
    const { store: flow } = open(large);
    // It opens at its root, where it can be read.
    await waitFor(() => expect(flow.getState().transform[2]).toBe(0.7));
    act(() => flow.setState({ transform: [0, 0, 0.3] }));
    expect(canvas()).not.toHaveAttribute('data-whole');
    act(() => flow.setState({ transform: [0, 0, 0.2] }));
    expect(canvas()).toHaveAttribute('data-whole', 'true');
    expect(await screen.findByTestId('whole-tree')).toBeInTheDocument();
    expect(document.querySelector('.react-flow__edge')).toBeNull();
    select('n4');
    canvas().focus();
    fireEvent.keyDown(canvas(), { key: 'Enter' });
    await waitFor(() => expect(canvas()).not.toHaveAttribute('data-whole'));
    expect(now.selection()).toEqual(['n4']);
  });

  it('is not, where all of it fits at a zoom at which it can be read', () => {
    const { store: flow } = open();
    act(() => flow.setState({ transform: [0, 0, 0.1] }));
    expect(canvas()).not.toHaveAttribute('data-whole');
  });
});
