import { displayName, freshId, type Diagram } from '@/model/diagram';
import { areNeighbours, extractSubtree, inlineSubtree } from '@/model/edits';
import { activeDiagram, change } from './blocks';
import { useProjectStore } from '../index';

/** Returns a tree name made from a block's name: letters and digits, not used by another tree or type. */
function freeTreeId(wanted: string): string {
  const { diagrams, vocabulary } = useProjectStore.getState();
  const words = wanted.split(/[^\p{L}\p{N}]+/u).filter(Boolean);
  const base = words.map((word) => word.charAt(0).toUpperCase() + word.slice(1)).join('') || 'Subtree';
  const taken = (id: string) => id in diagrams || vocabulary.specs.has(id);
  let id = taken(base) ? `${base}Tree` : base;
  for (let count = 2; taken(id); count += 1) id = `${base}Tree${count}`;
  return id;
}

/** Extracts the selected blocks, which must be consecutive siblings, to a new tree. */
export function extractSelection(): void {
  const diagram = activeDiagram();
  const { selection } = useProjectStore.getState();
  const node = diagram?.nodes[selection.at(-1) ?? ''];
  if (!diagram || !node || !areNeighbours(diagram, selection)) return;
  const treeId = freeTreeId(displayName(node));
  const made: Record<string, unknown> = { ...diagram.nodes };
  const fresh = () => {
    const id = freshId(made);
    made[id] = true;
    return id;
  };
  const extracted = extractSubtree(diagram, selection, treeId, fresh);
  if (!extracted) return;
  const tree: Diagram = extracted.tree;
  const created = Object.keys(made).filter((id) => !(id in diagram.nodes) && !(id in tree.nodes));
  change('extract', [extracted.recipe], { also: { [treeId]: tree }, select: created });
}

/** Replaces the selected SubTree with the blocks of its tree. */
export function inlineSelection(): void {
  const diagram = activeDiagram();
  const { selection, diagrams } = useProjectStore.getState();
  const [id] = selection;
  const node = id === undefined ? undefined : diagram?.nodes[id];
  const tree = node?.tree === undefined ? undefined : diagrams[node.tree];
  if (id === undefined || tree?.root === null || tree === undefined) return;
  change('inline', [inlineSubtree(id, tree, (taken) => freshId(taken))], { select: [] });
}
