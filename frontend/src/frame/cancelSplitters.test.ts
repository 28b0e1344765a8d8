import { fireEvent } from '@testing-library/react';
import type { RowNode } from 'flexlayout-react';
import { Actions, type Action, type Model } from 'flexlayout-react';
import { expect, it, onTestFinished, vi } from 'vitest';
import { loadLayout } from '@/workspace/layoutModel';
import { cancelSplitters } from './cancelSplitters';

const weights = (model: Model) =>
  model
    .getRootRow()!
    .getChildren()
    .map((child) => (child as RowNode).getWeight());

function begin() {
  localStorage.clear();
  const model = loadLayout('wide', true);
  const end = cancelSplitters(document, model);
  const splitter = document.body.appendChild(document.createElement('div'));
  splitter.className = 'flexlayout__splitter';
  splitter.hasPointerCapture = () => true;
  splitter.releasePointerCapture = vi.fn();
  const lost = vi.fn();
  document.addEventListener('pointercancel', lost);
  onTestFinished(() => {
    end();
    splitter.remove();
    document.removeEventListener('pointercancel', lost);
  });
  const before = weights(model);
  /** Drags the line between two panels; the docking library resizes the panels meanwhile. */
  const drag = () => {
    fireEvent.pointerDown(splitter, { pointerId: 4, button: 0 });
    model.doAction(Actions.adjustWeights(model.getRootRow()!.getId(), [40, 30, 30]));
  };
  return { model, before, drag, lost, splitter, end };
}

it('Escape restores the sizes of the panels, and ends the drag', () => {
  const { model, before, drag, lost, splitter } = begin();
  drag();
  expect(weights(model)).toEqual([40, 30, 30]);
  fireEvent.keyDown(document.body, { key: 'Escape' });
  expect(weights(model)).toEqual(before);
  expect(lost).toHaveBeenCalledOnce();
  expect(splitter.releasePointerCapture).toHaveBeenCalledExactlyOnceWith(4);
});

it('the sizes are set as during a drag, and then drawn', () => {
  const { model, drag } = begin();
  drag();
  const listener = vi.fn((action: Action) => action.isAdjusting());
  model.addChangeListener(listener);
  fireEvent.keyDown(document.body, { key: 'Escape' });
  expect(listener.mock.results.map(({ value }) => value as boolean)).toEqual([true, false]);
});

it('a finished drag keeps its sizes', () => {
  const { model, drag } = begin();
  drag();
  fireEvent.pointerUp(document.body, { pointerId: 4 });
  fireEvent.keyDown(document.body, { key: 'Escape' });
  expect(weights(model)).toEqual([40, 30, 30]);
});

it('presses elsewhere, and presses after its end, have no effect', () => {
  const { model, drag, end, lost } = begin();
  fireEvent.pointerDown(document.body, { pointerId: 4, button: 0 });
  fireEvent.keyDown(document.body, { key: 'Escape' });
  end();
  drag();
  fireEvent.keyDown(document.body, { key: 'Escape' });
  expect(lost).not.toHaveBeenCalled();
  expect(weights(model)).toEqual([40, 30, 30]);
});
