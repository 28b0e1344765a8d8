import { act, fireEvent } from '@testing-library/react';
import type { MouseEvent } from 'react';
import { beforeEach, expect, it, onTestFinished, vi } from 'vitest';
import { useProjectStore } from '@/store/project';
import { inFlow, now, openDiagram } from '../../../../harness/canvas';
import { useBoxSelection } from './useBoxSelection';

beforeEach(() => {
  openDiagram(
    {
      root: 'r',
      nodes: { r: { type: 'Sequence', children: ['a', 'b'] }, a: { type: 'Sleep' }, b: { type: 'Sleep' } },
    },
    { selected: ['a'] },
  );
});

function begin(isCaptured = true) {
  const pane = document.body.appendChild(document.createElement('div'));
  pane.hasPointerCapture = () => isCaptured;
  const heard = vi.fn();
  for (const type of ['pointercancel', 'click']) pane.addEventListener(type, ({ type }) => heard(type));
  onTestFinished(() => pane.remove());
  const { used, store } = inFlow(() => useBoxSelection('Main'));
  act(() => used().onPress());
  act(() => useProjectStore.getState().select('Main', ['b']));
  store.setState({ userSelectionActive: true });
  act(() =>
    used().onSelectionStart({
      currentTarget: pane,
      nativeEvent: { pointerId: 5 },
    } as unknown as MouseEvent),
  );
  return { store, heard };
}

it('a rectangle that Escape cancels restores the selection', () => {
  const { store, heard } = begin();
  act(() => void fireEvent.keyDown(document.body, { key: 'Escape' }));
  expect(now.selection()).toEqual(['a']);
  expect(store.getState().userSelectionActive).toBe(false);
  expect(heard.mock.calls.flat()).toEqual(['pointercancel', 'click']);
});

it('a lost pointer is not released again', () => {
  const { heard } = begin(false);
  act(() => void fireEvent.blur(window));
  expect(now.selection()).toEqual(['a']);
  expect(heard.mock.calls.flat()).toEqual(['click']);
});

it('a finished rectangle selects', () => {
  begin();
  fireEvent.pointerUp(document.body, { pointerId: 5 });
  fireEvent.keyDown(document.body, { key: 'Escape' });
  expect(now.selection()).toEqual(['b']);
});
