import { subtreeOf, type Diagram, type DiagramNode } from './diagram';
import type { PortDirection, PortSpec } from './ports';
import { descriptionOf } from './treeAttributes';

/** Facts about a tree that other trees of the project need. */
export interface TreeFacts {
  /** The trees that the tree calls, not counting calls in drafts. */
  readonly calls: ReadonlySet<string>;
  /** The names that the tree passes to each tree that it calls; null if it shares all. */
  readonly passed: ReadonlyMap<string, ReadonlySet<string> | null>;
  /** The ports that the tree has as a SubTree. */
  readonly ports: readonly PortSpec[];
  /** The description of the tree; empty if there is none. */
  readonly description: string;
}

const DIRECTIONS: readonly string[] = ['input', 'output', 'inout'] satisfies PortDirection[];

const text = (value: unknown): string => (typeof value === 'string' ? value : '');

function portOf(value: unknown): PortSpec[] {
  const row: Record<string, unknown> = typeof value === 'object' && value !== null ? { ...value } : {};
  if (typeof row['name'] !== 'string') return [];
  const direction = text(row['direction']);
  return [
    {
      name: row['name'],
      direction: DIRECTIONS.includes(direction) ? (direction as PortDirection) : 'input',
      type: text(row['type']) || 'any',
      default: typeof row['default'] === 'string' ? row['default'] : null,
      required: row['required'] === true,
      description: text(row['description']),
    },
  ];
}

const AUTOREMAP = '_autoremap';

/** Returns the names that a SubTree passes; null if it shares all. */
export function passedBy(node: DiagramNode): readonly string[] | null {
  const { [AUTOREMAP]: asPort, ...given } = node.ports ?? {};
  const autoremap = asPort ?? node.attributes?.[AUTOREMAP] ?? '';
  return /^(?:true|1)$/i.test(autoremap) ? null : Object.keys(given);
}

function read(diagram: Diagram): TreeFacts {
  const ids = diagram.root === null ? [] : subtreeOf(diagram, diagram.root);
  const passed = new Map<string, ReadonlySet<string> | null>();
  for (const id of ids) {
    const node = diagram.nodes[id];
    if (node?.type !== 'SubTree' || !node.tree) continue;
    const [names, before] = [passedBy(node), passed.get(node.tree)];
    passed.set(node.tree, names === null || before === null ? null : new Set([...(before ?? []), ...names]));
  }
  const rows: readonly unknown[] = Array.isArray(diagram.ports) ? diagram.ports : [];
  return {
    calls: new Set(passed.keys()),
    passed,
    ports: rows.flatMap(portOf),
    description: descriptionOf(diagram),
  };
}

const known = new WeakMap<Diagram, TreeFacts>();

/** Returns the facts of a diagram, cached, since diagrams are immutable. */
export function treeFacts(diagram: Diagram): TreeFacts {
  const facts = known.get(diagram) ?? read(diagram);
  known.set(diagram, facts);
  return facts;
}

type Passed = ReadonlySet<string> | null;

const samePassed = (a: Passed, b: Passed | undefined): boolean =>
  a === b ||
  (a !== null && b !== null && b !== undefined && a.size === b.size && [...a].every((name) => b.has(name)));

/** Returns whether the facts of a tree are unchanged. */
export function sameFacts(a: TreeFacts, b: TreeFacts): boolean {
  const isSamePort = (port: PortSpec, index: number): boolean =>
    JSON.stringify(port) === JSON.stringify(b.ports[index]);
  return (
    a === b ||
    (a.description === b.description &&
      a.calls.size === b.calls.size &&
      [...a.passed].every(([tree, names]) => samePassed(names, b.passed.get(tree))) &&
      a.ports.length === b.ports.length &&
      a.ports.every(isSamePort))
  );
}
