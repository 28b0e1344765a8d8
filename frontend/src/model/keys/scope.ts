import type { Diagram, DiagramNode } from '../diagram';
import { readPortText } from '../ports';
import { treeFacts } from '../treeFacts';

/** The trees among which keys are renamed. */
export interface Forest {
  readonly diagrams: Readonly<Record<string, Diagram>>;
  readonly mainTree: string;
}

/** The blackboard of a tree by its id, or the shared one, whose keys are written `@key`. */
export type Board = string;
export const SHARED: Board = '@';

const isOn = (text: string | undefined): boolean => /^(?:true|1)$/i.test(text ?? '');

/** Whether a SubTree passes keys on that it does not name. */
export const hasAutoremap = ({ ports, attributes }: DiagramNode): boolean =>
  isOn(ports?.['_autoremap'] ?? attributes?.['_autoremap']);

/** What a SubTree passes for a port of its tree: its own text, or the default of the tree. */
export function passedFor(node: DiagramNode, port: string, called: Diagram | undefined): string | undefined {
  const own = node.ports?.[port];
  if (own !== undefined || hasAutoremap(node) || !called) return own;
  return treeFacts(called).ports.find(({ name }) => name === port)?.default ?? undefined;
}

/** The board of the caller's key that is the same entry as `key` in the called tree, under the same name. */
function boardOutside(caller: string, node: DiagramNode, key: string, called: Diagram): Board | null {
  const text = passedFor(node, key, called);
  if (text === undefined) return hasAutoremap(node) && !key.startsWith('_') ? caller : null;
  const value = readPortText(text);
  if (value.kind === 'same-name') return caller;
  if (value.kind !== 'key' || value.key !== key) return null;
  return value.global ? SHARED : caller;
}

/** Pairs of boards that hold one entry under the name of a key. */
function linksOf({ diagrams, mainTree }: Forest, key: string): (readonly [Board, Board])[] {
  const links: (readonly [Board, Board])[] = mainTree in diagrams ? [[SHARED, mainTree]] : [];
  for (const [caller, diagram] of Object.entries(diagrams)) {
    for (const node of Object.values(diagram.nodes)) {
      const called = node.type === 'SubTree' ? diagrams[node.tree ?? ''] : undefined;
      const outside = called && boardOutside(caller, node, key, called);
      if (called && outside) links.push([outside, called.id]);
    }
  }
  return links;
}

/**
 * All boards where a key is the same entry under the same name: where SubTrees pass it by name, by `{=}` or by
 * `_autoremap`. The main tree's own board is the shared one.
 */
export function scopeOf(forest: Forest, board: Board, key: string): ReadonlySet<Board> {
  const links = linksOf(forest, key);
  const scope = new Set([board]);
  for (const each of scope) {
    for (const [a, b] of links) {
      if (a === each) scope.add(b);
      if (b === each) scope.add(a);
    }
  }
  return scope;
}
