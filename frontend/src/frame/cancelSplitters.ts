import { Actions, RowNode, TabSetNode, type Model } from 'flexlayout-react';
import { cancellable } from '@/ui/cancellable';

/** Returns the weights of the children of each row of panels. */
function weightsOf(model: Model): ReadonlyMap<string, readonly number[]> {
  const weights = new Map<string, readonly number[]>();
  model.visitNodes((node) => {
    if (node instanceof RowNode) weights.set(node.getId(), childWeights(node));
  });
  return weights;
}

const childWeights = (row: RowNode): number[] =>
  row
    .getChildren()
    .map((child) => (child instanceof RowNode || child instanceof TabSetNode ? child.getWeight() : 0));

function restore(model: Model, weights: ReadonlyMap<string, readonly number[]>): void {
  for (const [id, before] of weights) {
    const row = model.getNodeById(id);
    if (!(row instanceof RowNode)) continue;
    if (childWeights(row).every((weight, at) => weight === before[at])) continue;
    // During a drag the library sets the sizes without React. React must first see another state, or it would
    // not draw the old one.
    model.doAction(Actions.adjustWeights(id, [...before]).setAdjusting(true));
    model.doAction(Actions.adjustWeights(id, [...before]));
  }
}

/**
 * Lets Escape cancel a drag of the line between two panels, which the docking library does not support: the
 * panels get their old sizes back. Returns a function that removes the listener.
 */
export function cancelSplitters(document: Document, model: Model): () => void {
  const onPress = (event: PointerEvent): void => {
    const splitter = (event.target as Element).closest('.flexlayout__splitter');
    if (!splitter || event.button !== 0) return;
    const weights = weightsOf(model);
    const { pointerId } = event;
    cancellable(splitter, pointerId, {
      onCancel: () => {
        document.dispatchEvent(new PointerEvent('pointercancel', { pointerId, cancelable: true }));
        if (splitter.hasPointerCapture(pointerId)) splitter.releasePointerCapture(pointerId);
        restore(model, weights);
      },
    });
  };
  document.addEventListener('pointerdown', onPress, { capture: true });
  return () => document.removeEventListener('pointerdown', onPress, { capture: true });
}
