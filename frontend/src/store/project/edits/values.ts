import { edit, setPort, type Recipe } from '@/model/edits';
import { useProjectStore } from '../index';

/** A text for a port of a block. */
export interface PortValue {
  readonly tree: string;
  readonly node: string;
  readonly port: string;
  readonly text: string;
}

/** Sets ports of blocks that exist, in one undo step of the first tree. */
export function setValues(values: readonly PortValue[]): void {
  const { diagrams, apply } = useProjectStore.getState();
  const byTree = new Map<string, Recipe[]>();
  for (const { tree, node, port, text } of values) {
    byTree.set(tree, [...(byTree.get(tree) ?? []), setPort(node, port, text)]);
  }
  const [first, ...others] = [...byTree];
  if (!first) return;
  const also = Object.fromEntries(
    others.flatMap(([tree, recipes]) => {
      const diagram = diagrams[tree];
      return diagram ? [[tree, edit(diagram, ...recipes).diagram]] : [];
    }),
  );
  apply(first[0], 'port', first[1], { also });
}
