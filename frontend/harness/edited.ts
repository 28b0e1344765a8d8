import { emptyDiagram, type Diagram } from '@/model/diagram';
import { edit, type Recipe } from '@/model/edits/core';
import { legalStep } from '@/model/testing';
import { emptyUndo, record, type UndoStack } from '@/model/undo';

export const RUNS = Number(process.env.BT_STUDIO_FULL ? 1000 : 200);
export const start: Diagram = {
  ...emptyDiagram('Main'),
  root: 'root',
  nodes: { root: { type: 'Sequence' } },
};

type Steps = readonly (readonly [number, number, number])[];

/** Makes legal edits, each a step of one undo stack. */
export function edited(from: Diagram, chosen: Steps): { diagram: Diagram; undoStack: UndoStack } {
  let diagram = from;
  let undoStack = emptyUndo;
  for (const step of chosen) {
    const recipe = legalStep(diagram, ...step);
    if (recipe) ({ diagram, undoStack } = done(diagram, undoStack, recipe));
  }
  return { diagram, undoStack };
}

/** Makes one step; its patches are those of all trees, as in the store. */
export function done(before: Diagram, undoStack: UndoStack, recipe: Recipe) {
  const { diagram, patches, inverse } = edit(before, recipe);
  const inTree = (each: readonly (typeof patches)[number][]) =>
    each.map((patch) => ({ ...patch, path: ['Main', ...patch.path] }));
  const entry = { label: 'step', mergeKey: null, patches: inTree(patches), inverse: inTree(inverse) };
  return { diagram, undoStack: record(undoStack, { ...entry, before: [], after: [] }) };
}

/** Empty lists and records say the same as absent ones. */
export function plain(diagram: Diagram): unknown {
  const nodes = Object.entries(diagram.nodes).map(([id, node]) => {
    const fields = Object.entries(node).filter(
      ([, value]) => typeof value !== 'object' || Object.keys(value as object).length > 0,
    );
    return [id, Object.fromEntries(fields)];
  });
  return { ...diagram, nodes: Object.fromEntries(nodes) };
}
