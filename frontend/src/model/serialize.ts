import { freeze, isDraft } from 'immer';
import {
  preorder,
  type Diagram,
  type DiagramNode,
  type NodeId,
  type Orientation,
  type Point,
} from './diagram';

/** Thrown for a text that is not a diagram; the message tells the user where and why. */
export class DiagramError extends Error {
  override readonly name = 'DiagramError';
}

type Json = Record<string, unknown>;

const isObject = (value: unknown): value is Json =>
  typeof value === 'object' && value !== null && !Array.isArray(value);

function texts(value: unknown, where: string): Record<string, string> {
  if (!isObject(value)) throw new DiagramError(`${where} must be an object of texts.`);
  return Object.fromEntries(
    Object.entries(value).map(([key, item]) => {
      if (isObject(item) || Array.isArray(item)) throw new DiagramError(`${where}.${key} must be a text.`);
      return [key, String(item)];
    }),
  );
}

function point(value: unknown): Point | undefined {
  if (!Array.isArray(value) || value.length !== 2) return undefined;
  const [x, y] = value as unknown[];
  return Number.isFinite(x) && Number.isFinite(y) ? [Number(x), Number(y)] : undefined;
}

function ids(value: unknown, where: string): NodeId[] {
  if (!Array.isArray(value)) throw new DiagramError(`${where} must be a list of node ids.`);
  return value.map(String);
}

/** Parses one node; unknown keys are kept. */
function parseNode(id: NodeId, value: unknown): DiagramNode {
  const where = `nodes.${id}`;
  if (!isObject(value) || typeof value['type'] !== 'string') {
    throw new DiagramError(`${where} needs a "type".`);
  }
  const { children, ports, conditions, attributes, silenced, position, ...rest } = value;
  const at = point(position);
  return {
    ...(rest as unknown as DiagramNode),
    ...(ports === undefined ? {} : { ports: texts(ports, `${where}.ports`) }),
    ...(conditions === undefined ? {} : { conditions: texts(conditions, `${where}.conditions`) }),
    ...(attributes === undefined ? {} : { attributes: texts(attributes, `${where}.attributes`) }),
    ...(silenced === undefined ? {} : { silenced: texts(silenced, `${where}.silenced`) }),
    ...(children === undefined ? {} : { children: ids(children, `${where}.children`) }),
    ...(at ? { position: at } : {}),
  };
}

type Nodes = Record<NodeId, DiagramNode>;

/** Removes children that do not exist, and second parents. */
function link(nodes: Nodes): void {
  const seen = new Set<NodeId>();
  for (const [id, node] of Object.entries(nodes)) {
    const children = node.children?.filter((child) => {
      if (!nodes[child] || seen.has(child) || child === id) return false;
      seen.add(child);
      return true;
    });
    if (children && children.length !== node.children?.length) nodes[id] = { ...node, children };
  }
}

const parentsIn = (nodes: Nodes): Map<NodeId, NodeId> =>
  new Map(
    Object.entries(nodes).flatMap(([id, { children }]) =>
      (children ?? []).map((child) => [child, id] as const),
    ),
  );

function cut(nodes: Nodes, parent: NodeId | undefined, child: NodeId): void {
  const node = nodes[parent ?? ''];
  if (parent === undefined || !node) return;
  nodes[parent] = { ...node, children: (node.children ?? []).filter((each) => each !== child) };
}

/** Adds a node and all below it to the nodes that were reached; returns whether it is below itself. */
function reach(nodes: Nodes, top: NodeId, reached: Set<NodeId>): boolean {
  const open = [...(nodes[top]?.children ?? [])];
  reached.add(top);
  for (let id = open.pop(); id !== undefined; id = open.pop()) {
    if (id === top) return true;
    if (reached.has(id)) continue;
    reached.add(id);
    open.push(...(nodes[id]?.children ?? []));
  }
  return false;
}

/**
 * Repairs the nodes into a forest, like `translator/diagram.py`: dangling links and second parents are
 * dropped, rings are cut above their first node, and unconnected pieces become drafts, so that nothing is
 * lost.
 */
function repair(root: NodeId | null, drafts: NodeId[], nodes: Nodes) {
  link(nodes);
  const parents = parentsIn(nodes);
  const top = root !== null && nodes[root] ? root : null;
  const listed = [...new Set(drafts)].filter((id) => nodes[id] && !parents.has(id) && id !== top);
  if (top !== null) cut(nodes, parents.get(top), top);
  const reached = new Set<NodeId>();
  for (const id of top === null ? listed : [top, ...listed]) reach(nodes, id, reached);
  for (const id of Object.keys(nodes)) {
    if (!reached.has(id) && reach(nodes, id, reached)) cut(nodes, parents.get(id), id);
  }
  const left = parentsIn(nodes);
  const known = new Set([top, ...listed]);
  const lost = Object.keys(nodes).filter((id) => !left.has(id) && !known.has(id));
  return { root: top, drafts: [...listed, ...lost], nodes };
}

/** Reads and repairs a diagram, from text or from parsed JSON. */
export function parseDiagram(source: unknown): Diagram {
  let value = source;
  if (typeof source === 'string') {
    try {
      value = JSON.parse(source);
    } catch (error) {
      throw new DiagramError(`This is not JSON: ${error instanceof Error ? error.message : String(error)}`);
    }
  }
  if (!isObject(value)) throw new DiagramError('A diagram is a JSON object.');
  if (value['format'] !== 'bt-studio/diagram') {
    throw new DiagramError('"format" must be "bt-studio/diagram".');
  }
  if (value['version'] !== 1 && value['version'] !== 2) {
    throw new DiagramError(`Version ${String(value['version'])} is newer than this program reads (2).`);
  }
  if (!isObject(value['nodes'])) throw new DiagramError('"nodes" must be an object.');
  const nodes = Object.fromEntries(
    Object.entries(value['nodes']).map(([id, node]) => [id, parseNode(id, node)]),
  );
  const root = typeof value['root'] === 'string' ? value['root'] : null;
  const layout: Orientation = value['layout'] === 'horizontal' ? 'horizontal' : 'vertical';
  const diagram: Diagram = {
    ...(value as unknown as Diagram),
    id: String(value['id'] ?? ''),
    layout,
    ...repair(root, ids(value['drafts'] ?? [], 'drafts'), nodes),
  };
  // Edits do not copy frozen objects.
  return freeze(diagram, true);
}

const NODE_KEYS = [
  'type',
  'tree',
  'name',
  'children',
  'ports',
  'conditions',
  'comment',
  'color',
  'disabled',
  'collapsed',
  'position',
  'attributes',
  'silenced',
] as const satisfies readonly (keyof DiagramNode)[];

function orderedNode(node: DiagramNode): Json {
  const known = NODE_KEYS.filter((key) => node[key] !== undefined).map((key) => [key, node[key]] as const);
  const unknown = Object.entries(node)
    .filter(([key]) => !NODE_KEYS.includes(key as (typeof NODE_KEYS)[number]))
    .sort(([a], [b]) => a.localeCompare(b));
  return Object.fromEntries([...known, ...unknown]);
}

/** Returns JSON on one line with a space after each comma and colon, as in the examples. */
function inline(value: unknown): string {
  if (Array.isArray(value)) return `[${value.map(inline).join(', ')}]`;
  if (isObject(value)) {
    return `{${Object.entries(value)
      .map(([key, item]) => `${JSON.stringify(key)}: ${inline(item)}`)
      .join(', ')}}`;
  }
  return JSON.stringify(value);
}

const written = new WeakMap<DiagramNode, string>();

/** Returns a node as it is saved; cached, since nodes are immutable. */
function nodeText(node: DiagramNode): string {
  const known = written.get(node);
  if (known !== undefined) return known;
  const text = inline(orderedNode(node));
  // A draft is still mutable and must not be cached.
  if (!isDraft(node)) written.set(node, text);
  return text;
}

/** Writes a diagram: nodes in execution order, one on each line, so that diffs of revisions are readable. */
export function serializeDiagram(diagram: Diagram): string {
  const { format, version: _read, id, root, nodes, drafts, layout, ...rest } = diagram;
  // Earlier programs read files that silence nothing.
  const version = Object.values(nodes).some(({ silenced }) => silenced) ? 2 : 1;
  const lines = preorder(diagram).map((node) => {
    const content = nodes[node];
    return `    ${JSON.stringify(node)}: ${content ? nodeText(content) : '{}'}`;
  });
  const extra = Object.entries(rest).map(([key, value]) => `,\n  ${JSON.stringify(key)}: ${inline(value)}`);
  return `{
  "format": ${JSON.stringify(format)},
  "version": ${version},
  "id": ${JSON.stringify(id)},
  "root": ${JSON.stringify(root)},
  "nodes": {${lines.length > 0 ? `\n${lines.join(',\n')}\n  ` : ''}},
  "drafts": ${inline(drafts)},
  "layout": ${JSON.stringify(layout)}${extra.join('')}
}
`;
}
