import { expect, it } from 'vitest';
import { inFlow } from '../../../../harness/canvas';
import { useKnownSizes } from './useKnownSizes';

it('prevents React Flow from measuring blocks', () => {
  const measuring = inFlow(() => undefined).store.getState().updateNodeInternals;
  const { store, rerender } = inFlow(useKnownSizes);
  const { updateNodeInternals } = store.getState();
  expect(String(updateNodeInternals)).not.toBe(String(measuring));
  const before = store.getState().nodeLookup;
  updateNodeInternals(new Map([['a', { id: 'a', nodeElement: document.createElement('div') }]]));
  expect(store.getState().nodeLookup).toBe(before);
  rerender();
  expect(store.getState().updateNodeInternals).toBe(updateNodeInternals);
});
