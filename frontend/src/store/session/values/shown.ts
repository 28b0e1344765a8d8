import { create } from 'zustand';
import type { NodeId } from '@/model/diagram';
import { useProjectStore } from '@/store/project';

/** A port whose value is shown in its block: `<tree>/<node>/<port>`. */
export type ShownPort = string;

export const shownPort = (tree: string, node: NodeId, port: string): ShownPort => `${tree}/${node}/${port}`;

/** Returns the tree, block and port of a key; names of trees can contain the separator. */
export function partsOf(shown: ShownPort): { tree: string; node: NodeId; port: string } {
  const parts = shown.split('/');
  const [node = '', port = ''] = parts.slice(-2);
  return { tree: parts.slice(0, -2).join('/'), node, port };
}

const storageKey = (projectId: string) => `bts.values.${projectId}`;

function kept(projectId: string): ReadonlySet<ShownPort> {
  try {
    const list = JSON.parse(localStorage.getItem(storageKey(projectId)) ?? '[]') as unknown;
    return new Set(Array.isArray(list) ? list.filter((each) => typeof each === 'string') : []);
  } catch {
    return new Set();
  }
}

interface ShownValues {
  readonly projectId: string | null;
  readonly ports: ReadonlySet<ShownPort>;
}

/**
 * The ports whose values are shown in their blocks. They are stored in this browser for each project, not in
 * the tree.
 */
export const useShownValues = create<ShownValues>(() => ({ projectId: null, ports: new Set() }));

/** Loads the stored choice for the open project. */
function follow(projectId: string | null): void {
  if (useShownValues.getState().projectId === projectId) return;
  useShownValues.setState({ projectId, ports: projectId === null ? new Set() : kept(projectId) });
}

follow(useProjectStore.getState().projectId);
useProjectStore.subscribe(({ projectId }) => {
  follow(projectId);
});

function keep(ports: ReadonlySet<ShownPort>): void {
  const { projectId } = useShownValues.getState();
  useShownValues.setState({ ports });
  if (projectId === null) return;
  if (ports.size === 0) localStorage.removeItem(storageKey(projectId));
  else localStorage.setItem(storageKey(projectId), JSON.stringify([...ports]));
}

/** Shows or hides the values of some ports. */
export function showValues(ports: readonly ShownPort[], isShown: boolean): void {
  const next = new Set(useShownValues.getState().ports);
  for (const port of ports) {
    if (isShown) next.add(port);
    else next.delete(port);
  }
  keep(next);
}

/** Keeps showing the values of a tree that was renamed. */
export function followTreeRename(from: string, to: string): void {
  const { ports } = useShownValues.getState();
  const next = [...ports].map((each) => {
    const { tree, node, port } = partsOf(each);
    return tree === from ? shownPort(to, node, port) : each;
  });
  keep(new Set(next));
}
