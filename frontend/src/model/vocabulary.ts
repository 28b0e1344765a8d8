import type { Diagram, DiagramNode } from './diagram';
import { pointerOf, type PortDirection, type PortSpec } from './ports';
import type { TreeFacts } from './treeFacts';

export type Family = 'control' | 'decorator' | 'action' | 'condition' | 'subtree';

/** The description of a node type: from the catalogue, an action, or a subtree. */
export interface NodeSpec {
  readonly type: string;
  readonly family: Family;
  readonly symbol: string;
  readonly minChildren: number;
  readonly maxChildren: number;
  readonly ports: readonly PortSpec[];
  readonly summary: string;
  /** Whether the node accepts any port name. */
  readonly open: boolean;
  /** `offered`: an action of Nav2 that the project has not taken yet. */
  /** `ros` for built-in nodes that BehaviorTree.CPP has not. */
  readonly group?: string;
  readonly source: 'builtin' | 'action' | 'subtree' | 'offered';
  /** Whether the Python of the action has a syntax error now: then this is its last valid declaration. */
  readonly outdated?: boolean;
}

/** The fields of an action's description (REST `ActionModel`) that the model reads. */
export interface ActionDescription {
  readonly name: string;
  readonly doc?: string | undefined;
  readonly kind: string;
  /** The allowed number of children; absent: that of the kind. A `max` of null allows any number. */
  readonly children?: { readonly min: number; readonly max: number | null } | undefined;
  readonly open: boolean;
  readonly outdated?: boolean | undefined;
  readonly ports: readonly {
    readonly name: string;
    readonly direction: PortDirection;
    readonly type: string;
    readonly default?: string | number | boolean | null | undefined;
    readonly required?: boolean | undefined;
    readonly description?: string | undefined;
  }[];
}

/** All node types of one project, with facts about its trees. */
export interface Vocabulary {
  readonly specs: ReadonlyMap<string, NodeSpec>;
  readonly trees: ReadonlyMap<string, TreeFacts>;
  readonly mainTree: string;
  /** The trees that run: the main tree and those that it calls. */
  readonly reachable: ReadonlySet<string>;
}

interface CatalogDocument {
  readonly nodes: readonly {
    readonly type: string;
    readonly kind: string;
    readonly symbol: string;
    readonly children: { readonly min: number; readonly max: number | null };
    readonly ports: readonly {
      readonly name: string;
      readonly direction: string;
      readonly type: string;
      readonly default: string | null;
      readonly required: boolean;
      readonly description: string;
      /** The values that the port can have. */
      readonly enum?: readonly string[];
    }[];
    readonly summary: string;
    /** `ros` for nodes that BehaviorTree.CPP does not have. */
    readonly group?: string;
    readonly open?: boolean;
  }[];
}

/** Reads `tree_gardener/catalog.json`. */
export function readCatalog(document: CatalogDocument): readonly NodeSpec[] {
  return document.nodes.map((node) => ({
    type: node.type,
    family: node.kind as Family,
    symbol: node.symbol,
    minChildren: node.children.min,
    maxChildren: node.children.max ?? Infinity,
    ports: node.ports.map(({ enum: names, ...port }) => ({
      ...(port as PortSpec),
      // A string with given values is a choice in the inspector.
      ...(port.type === 'string' && names ? { type: `${port.name}[${names.join(';')}]` } : {}),
    })),
    summary: node.summary,
    open: node.kind === 'subtree' || (node.open ?? false),
    source: node.kind === 'subtree' ? 'subtree' : 'builtin',
    ...(node.group === undefined ? {} : { group: node.group }),
  }));
}

/**
 * The kinds of classes in `actions/`: their symbol, and the number of children unless the class declares it.
 */
const OWN = {
  action: { symbol: '▶', min: 0, max: 0 },
  condition: { symbol: '?', min: 0, max: 0 },
  control: { symbol: '◆', min: 1, max: null },
  decorator: { symbol: '◈', min: 1, max: 1 },
} as const;

function ownFamily(kind: string): keyof typeof OWN {
  const family = kind.toLowerCase();
  return family === 'condition' || family === 'control' || family === 'decorator' ? family : 'action';
}

/** Returns the spec of an action of the project. */
export function actionSpec(action: ActionDescription): NodeSpec {
  const family = ownFamily(action.kind);
  const { min, max } = action.children ?? OWN[family];
  return {
    type: action.name,
    family,
    symbol: OWN[family].symbol,
    minChildren: min,
    maxChildren: max ?? Infinity,
    ports: action.ports.map((port) => ({
      name: port.name,
      direction: port.direction,
      type: port.type,
      default: port.default === undefined || port.default === null ? null : String(port.default),
      required: port.required ?? false,
      description: port.description ?? '',
    })),
    summary: action.doc ?? '',
    open: action.open,
    source: 'action',
    ...(action.outdated ? { outdated: true } : {}),
  };
}

export function makeVocabulary(
  catalog: readonly NodeSpec[],
  actions: readonly ActionDescription[] = [],
  trees: ReadonlyMap<string, TreeFacts> = new Map(),
  mainTree = '',
): Vocabulary {
  const specs = new Map<string, NodeSpec>();
  // A built-in node with the same name takes precedence, as in the engine's loader.
  for (const action of actions) specs.set(action.name, actionSpec(action));
  for (const spec of catalog) specs.set(spec.type, spec);
  return { specs, trees, mainTree, reachable: trees.has(mainTree) ? called(trees, mainTree) : new Set() };
}

export function specOf(vocabulary: Vocabulary, node: Pick<DiagramNode, 'type'>): NodeSpec | undefined {
  return vocabulary.specs.get(node.type);
}

/** Returns whether a call of `used` in `user` would make a tree contain itself. */
export function wouldRecurse(vocabulary: Vocabulary, user: string, used: string): boolean {
  return called(vocabulary.trees, used).has(user);
}

/** Returns a tree and all trees that it calls, directly or indirectly. */
function called(trees: Vocabulary['trees'], start: string): ReadonlySet<string> {
  const seen = new Set([start]);
  for (const tree of seen) {
    for (const next of trees.get(tree)?.calls ?? []) seen.add(next);
  }
  return seen;
}

/** Returns the blackboard keys in a diagram's ports, each with the types of its uses. */
export function blackboardKeys(
  diagram: Diagram,
  vocabulary: Vocabulary,
): ReadonlyMap<string, ReadonlySet<string>> {
  const keys = new Map<string, Set<string>>();
  for (const node of Object.values(diagram.nodes)) {
    const spec = specOf(vocabulary, node);
    for (const [name, text] of Object.entries(node.ports ?? {})) {
      const key = pointerOf(text);
      if (key === null) continue;
      const types = keys.get(key === '=' ? name : key) ?? new Set<string>();
      const type = spec?.ports.find((port) => port.name === name)?.type;
      if (type) types.add(type);
      keys.set(key === '=' ? name : key, types);
    }
  }
  return keys;
}
