import { act, fireEvent, screen } from '@testing-library/react';
import { beforeEach, describe, expect, it, vi } from 'vitest';
import { childrenOf } from '@/model/diagram';
import { useProjectStore } from '@/store/project';
import { now, openDiagram } from '../../../harness/canvas';
import { action, nodeOf, show, watchNavigation } from '../../../harness/testing';
import { Outline } from './Outline';

const store = () => useProjectStore.getState();
const outline = () => screen.getByTestId('outline');
const ids = () => screen.queryAllByRole('treeitem').map(({ id }) => id.slice('outline-'.length));
const select = (...chosen: string[]) => act(() => store().select('Main', chosen));
const chosen = () => screen.getAllByRole('treeitem', { selected: true }).map(({ id }) => id);
/** Presses a key; returns whether the outline handled it. */
const press = (key: string) => !fireEvent.keyDown(outline(), { key });

function open(height = 560) {
  // jsdom has no layout; the height of the list determines how many lines are drawn.
  vi.spyOn(Element.prototype, 'clientHeight', 'get').mockReturnValue(height);
  vi.spyOn(Element.prototype, 'clientWidth', 'get').mockReturnValue(240);
  show(<Outline />);
}

beforeEach(() => {
  openDiagram(
    {
      root: 'r',
      nodes: {
        r: { type: 'Sequence', children: ['g', 'f', 'a'] },
        g: { type: 'Grasp' },
        f: { type: 'Fallback', children: ['x', 'y'] },
        x: { type: 'Sleep' },
        y: { type: 'Sleep' },
        a: { type: 'Sleep' },
        d: { type: 'Sleep' },
      },
      drafts: ['d'],
    },
    { actions: [action('Grasp')] },
  );
});

describe('the outline', () => {
  it('has a line for each block, in execution order', () => {
    open();
    expect(ids()).toEqual(['r', 'g', 'f', 'x', 'y', 'a', 'd']);
    const levels = screen.getAllByRole('treeitem').map((row) => row.getAttribute('aria-level'));
    expect(levels).toEqual(['1', '2', '2', '3', '3', '2', '1']);
    const tops = screen.getAllByRole('treeitem').map(({ style }) => style.transform);
    expect(tops.slice(0, 3)).toEqual(['translateY(0px)', 'translateY(28px)', 'translateY(56px)']);
    expect(outline().querySelector('[role=presentation]')).toHaveStyle({ height: `${7 * 28}px` });
  });

  it('draws the lines in view, and a few beyond', () => {
    const many = Array.from({ length: 60 }, (_, at) => `n${at}`);
    const leaves = Object.fromEntries(many.map((id) => [id, { type: 'Sleep' }]));
    openDiagram({ root: 'r', nodes: { r: { type: 'Sequence', children: many }, ...leaves } });
    open(280);
    expect(ids().length).toBeGreaterThanOrEqual(10);
    expect(ids().length).toBeLessThanOrEqual(10 + 8 + 1);
  });

  it('shows that there are no blocks yet, or no tree', () => {
    openDiagram({ root: null, nodes: {}, drafts: [] });
    open();
    expect(screen.getByText('The tree has no blocks yet.')).toBeInTheDocument();
    act(() => store().setActiveTree(null));
    expect(screen.getByText('The tree has no blocks yet.')).toBeInTheDocument();
    expect(screen.queryByRole('tree')).toBeNull();
  });

  it('marks the selected blocks; the first one is the active line', () => {
    open();
    expect(outline()).not.toHaveAttribute('aria-activedescendant');
    select('f', 'a');
    expect(chosen()).toEqual(['outline-f', 'outline-a']);
    expect(outline()).toHaveAttribute('aria-activedescendant', 'outline-f');
  });
});

describe('keys', () => {
  it('walk line by line, and stop at both ends', () => {
    open();
    for (const [key, id] of [
      ['ArrowDown', 'r'],
      ['ArrowUp', 'r'],
      ['ArrowDown', 'g'],
      ['ArrowDown', 'f'],
      ['ArrowUp', 'g'],
      ['End', 'd'],
      ['ArrowDown', 'd'],
      ['ArrowUp', 'a'],
      ['Home', 'r'],
    ] as const) {
      expect(press(key)).toBe(true);
      expect(now.selection()).toEqual([id]);
      expect(store().revealed).toMatchObject({ tree: 'Main', node: id });
    }
  });

  it('fold and unfold a block that has children, each once', () => {
    open();
    select('f');
    expect(press('ArrowLeft')).toBe(true);
    expect(nodeOf('Main', 'f')?.collapsed).toBe(true);
    expect(ids()).toEqual(['r', 'g', 'f', 'a', 'd']);
    press('ArrowLeft');
    press('ArrowRight');
    expect(nodeOf('Main', 'f')?.collapsed).toBeUndefined();
    press('ArrowRight');
    const labels = store().histories['Main']?.past.map(({ label }) => label);
    expect(labels).toEqual(['fold', 'unfold']);
  });

  it('fold no leaf', () => {
    open();
    select('a');
    expect(press('ArrowLeft')).toBe(true);
    expect(store().histories['Main']).toBeUndefined();
  });

  it('Delete removes the selected block', () => {
    open();
    select('f');
    expect(press('Delete')).toBe(true);
    expect(childrenOf(now.diagram(), 'r')).toEqual(['g', 'a']);
    expect(ids()).toEqual(['r', 'g', 'a', 'd']);
  });

  it('Enter opens the code of an action, and nothing else', () => {
    const { openFile } = watchNavigation();
    open();
    expect(press('Enter')).toBe(false);
    select('a');
    expect(press('Enter')).toBe(true);
    expect(openFile).not.toHaveBeenCalled();
    select('g');
    press('Enter');
    expect(openFile).toHaveBeenCalledExactlyOnceWith('actions/Grasp.py');
  });

  it('without a meaning here are left to the page', () => {
    open();
    select('a');
    expect(press('F5')).toBe(false);
    expect(press('x')).toBe(false);
  });
});
