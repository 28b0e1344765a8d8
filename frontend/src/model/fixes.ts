import { resultFixes } from './check/resultFixes';
import { freshId, type Diagram, type DiagramNode, type NodeId } from './diagram';
import { removeSubtrees, setCondition, setDisabled, setName, setPort, wrap, type Recipe } from './edits';
import { assign, nodeOf } from './edits/core';
import type { PortSpec } from './ports';
import type { Problem } from './problems';
import { fit, partRead } from './values';
import { wouldRecurse, type Vocabulary } from './vocabulary';
import { isPythonName } from './pythonNames';
import { similarNames } from './similar';

/** The effect of a fix that is not a change of the tree: it creates or changes a file. */
export type Making =
  | {
      readonly makes: 'action';
      readonly name: string;
      readonly ports: readonly string[];
      /** The kind of a node with children; absent for an action. */
      readonly kind?: 'Control' | 'Decorator';
    }
  | { readonly makes: 'tree'; readonly name: string }
  /** Another topic in the text of an action; `line` is that of the call that names it. */
  | {
      readonly makes: 'topic';
      readonly path: string;
      readonly line: number | null;
      readonly said: string;
      readonly other: string;
    }
  /** Nothing but the focus in the field of a port: the user types the value. */
  | { readonly makes: 'typing'; readonly node: NodeId; readonly port: string }
  /** Another name of a sensor's topic, at the first robot of a universe. */
  | { readonly makes: 'remap'; readonly path: string; readonly sensor: string; readonly topic: string };

/** A fix of a finding; its texts are `editor:fix.<key>` with `values`. */
export interface Fix {
  readonly key: string;
  readonly values: Readonly<Record<string, string>>;
  readonly does: Recipe | Making;
}

/** The part of a finding that determines its fixes: the editor's kind, or the server's code. */
export type Fixable =
  | Pick<Problem, 'kind' | 'node' | 'port'>
  | { readonly code: string; readonly node: NodeId | null; readonly port?: string | undefined };

const fix = (key: string, does: Fix['does'], values: Fix['values'] = {}): Fix => ({ key, values, does });

const setType =
  (id: NodeId, type: string, tree?: string): Recipe =>
  (draft) => {
    const node = nodeOf(draft, id);
    node.type = type;
    assign(node, 'tree', tree);
  };

function typeFixes(id: NodeId, node: DiagramNode, vocabulary: Vocabulary): Fix[] {
  if (vocabulary.trees.has(node.type)) {
    return [fix('call-tree', setType(id, 'SubTree', node.type), { name: node.type })];
  }
  const fits = [...vocabulary.specs.values()].filter(
    (spec) => (node.children?.length ?? 0) <= spec.maxChildren,
  );
  const known = similarNames(
    node.type,
    fits.map((spec) => spec.type),
  ).map((name) => fix('rename-type', setType(id, name), { name }));
  const trees = similarNames(node.type, vocabulary.trees.keys(), 1).map((name) =>
    fix('call-tree', setType(id, 'SubTree', name), { name }),
  );
  const count = node.children?.length ?? 0;
  const kind =
    count > 1 ? ({ kind: 'Control' } as const) : count === 1 ? ({ kind: 'Decorator' } as const) : {};
  const made = isPythonName(node.type)
    ? [
        fix(
          'make-action',
          { makes: 'action', name: node.type, ports: Object.keys(node.ports ?? {}), ...kind },
          { name: node.type },
        ),
      ]
    : [];
  return [...known, ...trees, ...made];
}

function treeFixes(diagram: Diagram, id: NodeId, node: DiagramNode, vocabulary: Vocabulary): Fix[] {
  const possible = [...vocabulary.trees.keys()].filter(
    (tree) => tree !== diagram.id && !wouldRecurse(vocabulary, diagram.id, tree),
  );
  const name = node.tree ?? '';
  const near = name === '' ? possible.slice(0, 3) : similarNames(name, possible);
  const calls = near.map((tree) => fix('call-tree', setType(id, 'SubTree', tree), { name: tree }));
  return /^[\w.-]+$/.test(name) && !vocabulary.trees.has(name)
    ? [...calls, fix('make-tree', { makes: 'tree', name }, { name })]
    : calls;
}

const keyOf = (text: string, port: string): string =>
  `{${/^@?[A-Za-z_]\w*$/.test(text.trim()) ? text.trim() : port}}`;

const keyFix = (id: NodeId, port: string, text: string): Fix =>
  fix('use-key', setPort(id, port, keyOf(text, port)), { text: keyOf(text, port) });

const typeFix = (node: NodeId, port: string): Fix => fix('type-value', { makes: 'typing', node, port });

function unknownPortFixes(id: NodeId, node: DiagramNode, port: string, ports: readonly PortSpec[]): Fix[] {
  const free = ports.map((each) => each.name).filter((name) => node.ports?.[name] === undefined);
  const renames = similarNames(port, free).map((name) =>
    fix('rename-port', renameOwn(id, port, name), { port, name }),
  );
  return [...renames, fix('remove-port', setPort(id, port, null), { port })];
}

const renameOwn =
  (id: NodeId, from: string, to: string): Recipe =>
  (draft) => {
    const node = nodeOf(draft, id);
    node.ports = Object.fromEntries(
      Object.entries(node.ports ?? {}).map(([name, text]) => [name === from ? to : name, text]),
    );
  };

const setAutoremap =
  (id: NodeId, text: string): Recipe =>
  (draft) => {
    const node = nodeOf(draft, id);
    const { _autoremap: _given, ...ports } = node.ports ?? {};
    assign(node, 'ports', Object.keys(ports).length > 0 ? ports : undefined);
    node.attributes = { ...node.attributes, _autoremap: text };
  };

const portsOf = (node: DiagramNode, { specs, trees }: Vocabulary): readonly PortSpec[] =>
  (node.type === 'SubTree' ? trees.get(node.tree ?? '') : specs.get(node.type))?.ports ?? [];

function valueFixes(id: NodeId, port: PortSpec, text: string): Fix[] {
  const fixes: Fix[] = [];
  const point = text.trim().replace(',', '.');
  if (point !== text && fit(port.type, point) === 'good') {
    fixes.push(fix('set-port', setPort(id, port.name, point), { text: point }));
  }
  const part = partRead(port.type, text) ?? '';
  if (part !== '' && part !== text) {
    fixes.push(fix('set-port', setPort(id, port.name, part), { text: part }));
  }
  if (port.default !== null)
    fixes.push(fix('reset-port', setPort(id, port.name, null), { text: port.default }));
  return [...fixes, typeFix(id, port.name), keyFix(id, port.name, text)];
}

function portFixes(
  problem: { kind: string; port: string },
  id: NodeId,
  node: DiagramNode,
  vocabulary: Vocabulary,
): Fix[] {
  const { port } = problem;
  const text = node.ports?.[port] ?? '';
  const ports = portsOf(node, vocabulary);
  const declared = ports.find((each) => each.name === port);
  switch (problem.kind) {
    case 'missing-port':
    case 'missing-tree-port':
      return [typeFix(id, port), keyFix(id, port, '')];
    case 'missing-key':
      return [keyFix(id, port, '')];
    case 'out-of-range':
    case 'bad-ros-name':
      return [typeFix(id, port)];
    case 'unknown-port':
      return unknownPortFixes(id, node, port, ports);
    case 'bad-port-name':
      return unknownPortFixes(id, node, port, ports);
    case 'unclosed-brace':
    case 'bad-key':
      return [keyFix(id, port, text.replace(/[{}]/g, ''))];
    case 'empty-key':
      return [fix('set-port', setPort(id, port, '{=}'), { text: '{=}' })];
    case 'output-literal':
      return [keyFix(id, port, text)];
    case 'wrong-type':
    case 'read-in-part':
      return declared ? valueFixes(id, declared, text) : [];
    case 'whole-for-double':
      return [fix('set-port', setPort(id, port, `${text}.0`), { text: `${text}.0` })];
    case 'empty-script':
      return [fix('remove-condition', setCondition(id, port, null), { port })];
    default:
      return [];
  }
}

function kindFixes(
  problem: Pick<Problem, 'kind' | 'port'>,
  diagram: Diagram,
  id: NodeId,
  vocabulary: Vocabulary,
): Fix[] {
  const node = diagram.nodes[id];
  if (!node) return [];
  switch (problem.kind) {
    case 'unknown-type':
      return typeFixes(id, node, vocabulary);
    case 'missing-tree':
    case 'unknown-tree':
    case 'recursion':
      return treeFixes(diagram, id, node, vocabulary);
    case 'too-many-children': {
      const spec = vocabulary.specs.get(node.type);
      if (spec?.maxChildren !== 1) return [];
      return [fix('wrap-children', wrap(node.children ?? [], freshId(diagram.nodes), { type: 'Sequence' }))];
    }
    case 'two-waiting-children':
      return [fix('rename-type', setType(id, 'Sequence'), { name: 'Sequence' })];
    case 'same-call-name':
      return [fix('remove-name', setName(id, ''))];
    case 'bad-autoremap':
      return ['true', 'false'].map((text) => fix('set-port', setAutoremap(id, text), { text }));
    case 'draft':
      return [fix('delete', removeSubtrees([id]))];
    case 'empty-tree':
    case 'too-few-children':
      return [];
    default:
      return problem.port === undefined
        ? []
        : portFixes({ kind: problem.kind, port: problem.port }, id, node, vocabulary);
  }
}

/** Returns the fixes of a finding, the most likely one first. */
export function fixesFor(problem: Fixable, diagram: Diagram, vocabulary: Vocabulary): Fix[] {
  const id = problem.node;
  if (id === null || !(id in diagram.nodes)) return [];
  if ('kind' in problem) return kindFixes(problem, diagram, id, vocabulary);
  if (problem.code === 'BT0105') return [fix('enable', setDisabled([id], false))];
  return resultFixes(problem.code, diagram, id, problem.port).map((each) =>
    fix(each.key, each.does, each.values),
  );
}

/** Returns the fixes of a finding about a file: those of a topic that nobody publishes (BT0623). */
export function fileFixes(
  code: string,
  path: string,
  line: number | null,
  values: Readonly<Record<string, unknown>> = {},
): Fix[] {
  if (code !== 'BT0623') return [];
  const { topic, sensor, other, said, universe } = values;
  const texts = [topic, sensor, other, said].filter((each) => typeof each === 'string');
  const [named = '', part = '', offered = '', written = ''] = texts;
  if (texts.length < 4) return [];
  const topicFix = { makes: 'topic', path, line, said: written, other: offered } as const;
  const use = fix('use-topic', topicFix, { other: offered });
  if (typeof universe !== 'string' || universe === '') return [use];
  const remap = { makes: 'remap', path: universe, sensor: part, topic: named } as const;
  return [use, fix('remap-topic', remap, { sensor: part, topic: named })];
}
