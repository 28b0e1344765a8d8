import type { Diagram, DiagramNode } from '../diagram';
import { readPortText } from '../ports';
import { treeFacts } from '../treeFacts';

/** The trees among which keys are renamed. */
export interface Forest {
  readonly diagrams: Readonly<Record<string, Diagram>>;
  readonly mainTree: string;
}

/**
 * The id of the tree that a blackboard belongs to, or `@` for the shared blackboard, whose keys are written
 * `@key`.
 */
export type Board = string;
export const SHARED: Board = '@';

const isOn = (text: string | undefined): boolean => /^(?:true|1)$/i.test(text ?? '');

/** Returns whether a SubTree also passes keys that it does not name. */
export const hasAutoremap = ({ ports, attributes }: DiagramNode): boolean =>
  isOn(ports?.['_autoremap'] ?? attributes?.['_autoremap']);

/** Returns the text that a SubTree passes for a port of its tree: its own, or the default of the tree. */
export function passedFor(node: DiagramNode, port: string, called: Diagram | undefined): string | undefined {
  const own = node.ports?.[port];
  if (own !== undefined || hasAutoremap(node) || !called) return own;
  return treeFacts(called).ports.find(({ name }) => name === port)?.default ?? undefined;
}

/**
 * Returns the caller's blackboard if `key` of the called tree is the same entry there, under the same name.
 */
function boardOutside(caller: string, node: DiagramNode, key: string, called: Diagram): Board | null {
  const text = passedFor(node, key, called);
  if (text === undefined) return hasAutoremap(node) && !key.startsWith('_') ? caller : null;
  const value = readPortText(text);
  if (value.kind === 'same-name') return caller;
  if (value.kind !== 'key' || value.key !== key) return null;
  return value.global ? SHARED : caller;
}

/** Returns the pairs of blackboards that share an entry under the name of a key. */
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
 * Returns all blackboards where a key is the same entry under the same name: SubTrees pass it by name, by
 * `{=}` or by `_autoremap`. The blackboard of the main tree is the shared one.
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
