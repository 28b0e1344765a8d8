import { addPort, edit, removePort, renamePort, type Recipe } from '@/model/edits';
import { useProjectStore } from '../index';

/** Changes every tree in one undo step of the active tree. */
function changeEverywhere(recipe: Recipe): void {
  const { activeTree, diagrams, apply } = useProjectStore.getState();
  if (activeTree === null) return;
  const others = Object.entries(diagrams).filter(([id]) => id !== activeTree);
  const also = Object.fromEntries(others.map(([id, diagram]) => [id, edit(diagram, recipe).diagram]));
  apply(activeTree, 'port', [recipe], { also });
}

/** Edits of the ports of an action without declarations: all its blocks have the same ports. */
export const shared = {
  add: (type: string, name: string): void => changeEverywhere(addPort(type, name)),
  rename: (type: string, from: string, to: string): void => changeEverywhere(renamePort(type, from, to)),
  remove: (type: string, name: string): void => changeEverywhere(removePort(type, name)),
};

/** Returns the ports that the blocks of a type set, in the order of their first use. */
export function portsInUse(type: string): readonly string[] {
  const diagrams = Object.values(useProjectStore.getState().diagrams);
  const nodes = diagrams.flatMap((diagram) => Object.values(diagram.nodes));
  const names = nodes.filter((node) => node.type === type).flatMap((node) => Object.keys(node.ports ?? {}));
  return [...new Set(names)];
}
