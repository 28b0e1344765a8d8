import { act, renderHook } from '@testing-library/react';
import { beforeEach, expect, it } from 'vitest';
import { setName } from '@/model/edits';
import { toggleExpanded } from '@/store/project/editor';
import { useProjectStore } from '@/store/project';
import { forgetEditor } from '../../../harness/canvas';
import { openProject } from '../../../harness/testing';
import { useTree } from './useTree';

const store = () => useProjectStore.getState();

beforeEach(() => {
  forgetEditor();
  openProject({
    trees: {
      Main: {
        r: { type: 'Sequence', children: ['s', 'x'] },
        s: { type: 'SubTree', tree: 'Dock' },
        x: { type: 'Lost' },
      },
      Dock: { d: { type: 'AlwaysSuccess' } },
    },
    diagnostics: [{ code: 'X1', severity: 'warning', message: 'Odd.', tree: 'Main', node: 's' }],
    selected: ['s'],
  });
});

it('has the blocks with their places, problems and selection', () => {
  const { result } = renderHook(() => useTree('Main'));
  const { diagram, shown, layout, problems, selection } = result.current;
  expect(diagram).toBe(store().diagrams['Main']);
  expect(shown.diagram).toBe(diagram);
  expect(Object.keys(layout.positions)).toEqual(['r', 's', 'x']);
  expect(problems.get('x')).toMatchObject({ source: 'editor', kind: 'unknown-type' });
  expect(problems.get('s')).toMatchObject({ source: 'server', code: 'X1' });
  expect([...selection]).toEqual(['s']);
});

it('has only the selection of the active tree', () => {
  const { result } = renderHook(() => useTree('Dock'));
  expect(result.current.selection.size).toBe(0);
  expect(Object.keys(result.current.layout.positions)).toEqual(['d']);
});

it('is empty for a deleted tree', () => {
  const { result } = renderHook(() => useTree('Gone'));
  expect(result.current.diagram).toMatchObject({ id: 'Gone', root: null });
  expect(result.current.layout.width).toBe(0);
});

it('draws an expanded subtree in its place, and follows its changes', () => {
  const { result } = renderHook(() => useTree('Main'));
  act(() => {
    toggleExpanded('Main', 's');
  });
  expect(Object.keys(result.current.layout.positions)).toEqual(['r', 's', 's d', 'x']);
  act(() => {
    store().apply('Dock', 'rename', [setName('d', 'Home')]);
  });
  expect(result.current.shown.diagram.nodes['s d']?.name).toBe('Home');
  act(() => {
    toggleExpanded('Main', 's');
  });
  expect(result.current.shown.diagram).toBe(result.current.diagram);
});

it('computes nothing again if another tree changes', () => {
  const { result } = renderHook(() => useTree('Main'));
  const before = result.current;
  act(() => {
    store().apply('Dock', 'rename', [setName('d', 'Home')]);
  });
  expect(result.current.layout).toBe(before.layout);
  expect(result.current.problems).toBe(before.problems);
});
