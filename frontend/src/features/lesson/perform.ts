import { setPort } from '@/model/edits';
import { findBlock, type Found } from '@/model/lesson/find';
import type { Try } from '@/model/lesson/parse';
import { specOf } from '@/model/vocabulary';
import { useProjectStore } from '@/store/project';
import { openFile, openTree } from '@/store/project/navigation';
import { runProject } from '@/store/run/run';

/** The outcome of a *Try it* button; its texts are `lesson:outcome.<kind>`. */
export interface Outcome {
  readonly kind: 'selected' | 'set' | 'opened' | 'running' | 'readOnly' | 'noBlock' | 'noPort' | 'noFile';
  readonly values: Readonly<Record<string, string>>;
}

function show({ tree, node }: Found): void {
  openTree(tree);
  useProjectStore.getState().reveal(tree, node);
}

function select(block: string): Outcome {
  const { diagrams, mainTree } = useProjectStore.getState();
  const found = findBlock(diagrams, mainTree, block);
  if (!found) return { kind: 'noBlock', values: { block } };
  show(found);
  return { kind: 'selected', values: { block } };
}

/** Sets a port in one undo step, and brings its tree to the front. */
function set({ block, port, value }: Extract<Try, { kind: 'set' }>): Outcome {
  const { diagrams, mainTree, vocabulary, role } = useProjectStore.getState();
  const values = { block, port, value };
  const found = findBlock(diagrams, mainTree, block);
  const node = found ? diagrams[found.tree]?.nodes[found.node] : undefined;
  if (!found || !node) return { kind: 'noBlock', values };
  const isKnown = specOf(vocabulary, node)?.ports.some(({ name }) => name === port) ?? false;
  if (!isKnown && !(port in (node.ports ?? {}))) return { kind: 'noPort', values };
  if (role === 'viewer') return { kind: 'readOnly', values };
  show(found);
  const { apply, seal } = useProjectStore.getState();
  seal(found.tree);
  apply(found.tree, 'port', [setPort(found.node, port, value)], { select: [found.node] });
  return { kind: 'set', values };
}

function open(path: string, line: number | null): Outcome {
  const { files } = useProjectStore.getState();
  if (!(path in files)) return { kind: 'noFile', values: { path } };
  openFile(path, line ?? undefined);
  return { kind: 'opened', values: { path } };
}

/** Performs the action of a *Try it* button. */
export function perform(act: Try): Outcome {
  switch (act.kind) {
    case 'select':
      return select(act.block);
    case 'set':
      return set(act);
    case 'open':
      return open(act.path, act.line);
    case 'run':
      void runProject();
      return { kind: 'running', values: {} };
  }
}
