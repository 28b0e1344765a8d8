import { childrenOf, displayName, freshId, parentOf, type Diagram, type NodeId } from '../diagram';
import { moveNode, removeSubtrees, setCondition, setPort, unwrap, wrap, type Recipe } from '../edits';
import { nodeOf } from '../edits/core';

/** A change that repairs a finding of the server's check of results; its text is `editor:fix.<key>`. */
export interface ResultFix {
  readonly key: string;
  readonly does: Recipe;
  readonly values: Readonly<Record<string, string>>;
}

/** The delay that gives the tick back in an endless loop, in ms. */
const PAUSE_MSEC = '100';

const PLAIN: Readonly<Record<string, string>> = {
  ReactiveSequence: 'Sequence',
  ReactiveFallback: 'Fallback',
};
const SEQUENCES: Readonly<Record<string, string>> = {
  Fallback: 'Sequence',
  AsyncFallback: 'AsyncSequence',
  ReactiveFallback: 'ReactiveSequence',
};
/** Nodes that work with one child fewer. */
const SHRINKS = new Set([
  ...Object.keys(SEQUENCES),
  ...Object.values(SEQUENCES),
  'SequenceWithMemory',
  'ParallelAll',
]);

/** Nodes of which a child keeps those behind it from being ticked, and whose children may change their order. */
const ORDERED = new Set([
  ...Object.keys(SEQUENCES),
  ...Object.values(SEQUENCES),
  'SequenceWithMemory',
  'NonblockingSequence',
  'PipelineSequence',
]);

const setType =
  (id: NodeId, type: string): Recipe =>
  (draft) => {
    nodeOf(draft, id).type = type;
  };

const fix = (key: string, does: Recipe, values: ResultFix['values'] = {}): ResultFix => ({
  key,
  does,
  values,
});

const insertDelay =
  (child: NodeId, id: NodeId): Recipe =>
  (draft) => {
    wrap([child], id, { type: 'Delay' })(draft);
    setPort(id, 'delay_msec', PAUSE_MSEC)(draft);
  };

function ofBranch(diagram: Diagram, id: NodeId, port: string | undefined): ResultFix[] {
  if (port?.startsWith('_')) return [fix('remove-condition', setCondition(id, port, null), { port })];
  const parent = diagram.nodes[parentOf(diagram, id) ?? ''];
  const shrinks = parent && SHRINKS.has(parent.type) && (parent.children?.length ?? 0) > 1;
  return shrinks ? [fix('remove-branch', removeSubtrees([id]))] : [];
}

/** The child before this one keeps it from being ticked: it goes before that one. */
function beforeElder(diagram: Diagram, id: NodeId): ResultFix[] {
  const parent = parentOf(diagram, id);
  const siblings = parent === null ? [] : childrenOf(diagram, parent);
  const index = siblings.indexOf(id) - 1;
  const elder = diagram.nodes[siblings[index] ?? ''];
  if (parent === null || !elder || !ORDERED.has(diagram.nodes[parent]?.type ?? '')) return [];
  return [fix('move-before', moveNode(id, { at: 'child', parent, index }), { name: displayName(elder) })];
}

function ofParent(diagram: Diagram, id: NodeId, types: Readonly<Record<string, string>>): ResultFix[] {
  const parent = parentOf(diagram, id);
  const type = types[diagram.nodes[parent ?? '']?.type ?? ''];
  return parent === null || type === undefined
    ? []
    : [fix('parent-type', setType(parent, type), { name: type })];
}

/** Returns the changes that repair a finding of the check of results at a block. */
export function resultFixes(code: string, diagram: Diagram, id: NodeId, port?: string): ResultFix[] {
  const [child] = childrenOf(diagram, id);
  switch (code) {
    case 'BT0114':
      return [...beforeElder(diagram, id), ...ofBranch(diagram, id, port)];
    case 'BT0117':
      return ofBranch(diagram, id, port);
    case 'BT0118':
      return ofParent(diagram, id, SEQUENCES);
    case 'BT0119':
    case 'BT0123':
      return [fix('unwrap', unwrap(id))];
    case 'BT0120':
      if (child === undefined) return [];
      return [fix('insert-delay', insertDelay(child, freshId(diagram.nodes)))];
    case 'BT0121':
      return ofParent(diagram, id, PLAIN);
    case 'BT0124':
      if (child === undefined) return [];
      return [
        fix('unwrap-both', (draft) => {
          unwrap(child)(draft);
          unwrap(id)(draft);
        }),
      ];
    default:
      return [];
  }
}
