import { preorder, subtreeOf, type Diagram, type DiagramNode, type NodeId } from './diagram';
import { literalProblem, readPortText, type PortSpec } from './ports';
import { specOf, wouldRecurse, type NodeSpec, type Vocabulary } from './vocabulary';

export type Severity = 'error' | 'warning' | 'note';

/** What is wrong, as data: the words are made by i18n (`problems:<kind>`) from `values`. */
export interface Problem {
  readonly kind:
    | 'empty-tree'
    | 'unknown-type'
    | 'too-few-children'
    | 'too-many-children'
    | 'missing-tree'
    | 'unknown-tree'
    | 'recursion'
    | 'missing-port'
    | 'unknown-port'
    | 'unclosed-brace'
    | 'empty-key'
    | 'output-literal'
    | 'wrong-type'
    | 'draft';
  readonly severity: Severity;
  readonly node: NodeId | null;
  readonly port?: string;
  readonly values: Readonly<Record<string, string | number>>;
}

function checkChildren(id: NodeId, node: DiagramNode, spec: NodeSpec): Problem[] {
  const count = node.children?.length ?? 0;
  const base = {
    severity: 'error',
    node: id,
    values: { type: node.type, count, min: spec.minChildren, max: spec.maxChildren },
  } as const;
  if (count < spec.minChildren) return [{ ...base, kind: 'too-few-children' }];
  if (count > spec.maxChildren) return [{ ...base, kind: 'too-many-children' }];
  return [];
}

function checkValue(id: NodeId, port: string, text: string, spec: PortSpec | undefined): Problem[] {
  const value = readPortText(text);
  const base = { severity: 'error', node: id, port, values: { port, text, type: spec?.type ?? '' } } as const;
  if (value.kind === 'broken') {
    return [{ ...base, kind: value.reason === 'unclosed' ? 'unclosed-brace' : 'empty-key' }];
  }
  if (!spec || value.kind === 'key' || value.kind === 'same-name') return [];
  if (value.kind === 'empty') {
    return spec.required ? [{ ...base, kind: 'missing-port' }] : [];
  }
  if (spec.direction === 'output') return [{ ...base, kind: 'output-literal' }];
  if (spec.direction === 'inout') return [];
  return literalProblem(spec.type, text) === null ? [] : [{ ...base, kind: 'wrong-type' }];
}

function checkPorts(id: NodeId, node: DiagramNode, spec: NodeSpec): Problem[] {
  const found: Problem[] = [];
  for (const port of spec.ports) {
    const text = node.ports?.[port.name];
    if (text === undefined && port.required && port.default === null) {
      found.push({
        kind: 'missing-port',
        severity: 'error',
        node: id,
        port: port.name,
        values: { port: port.name, type: port.type },
      });
    }
  }
  for (const [name, text] of Object.entries(node.ports ?? {})) {
    const port = spec.ports.find((each) => each.name === name);
    if (!port && !spec.open) {
      found.push({
        kind: 'unknown-port',
        severity: 'error',
        node: id,
        port: name,
        values: { port: name, type: node.type },
      });
    }
    found.push(...checkValue(id, name, text, port));
  }
  return found;
}

function checkSubtree(diagram: Diagram, id: NodeId, node: DiagramNode, vocabulary: Vocabulary): Problem[] {
  if (node.type !== 'SubTree') return [];
  const base = { severity: 'error', node: id, values: { tree: node.tree ?? '' } } as const;
  if (!node.tree) return [{ ...base, kind: 'missing-tree' }];
  if (!vocabulary.trees.has(node.tree)) return [{ ...base, kind: 'unknown-tree' }];
  return wouldRecurse(vocabulary, diagram.id, node.tree) ? [{ ...base, kind: 'recursion' }] : [];
}

function checkNode(diagram: Diagram, id: NodeId, vocabulary: Vocabulary): Problem[] {
  const node = diagram.nodes[id];
  if (!node) return [];
  const spec = specOf(vocabulary, node);
  if (!spec) return [{ kind: 'unknown-type', severity: 'error', node: id, values: { type: node.type } }];
  return [
    ...checkChildren(id, node, spec),
    ...checkSubtree(diagram, id, node, vocabulary),
    ...checkPorts(id, node, spec),
  ];
}

/** Everything that can be said about a diagram without the server, in execution order. */
export function findProblems(diagram: Diagram, vocabulary: Vocabulary): Problem[] {
  if (diagram.root === null && diagram.drafts.length === 0) {
    return [{ kind: 'empty-tree', severity: 'note', node: null, values: {} }];
  }
  const drafts = new Set(diagram.drafts.flatMap((draft) => subtreeOf(diagram, draft)));
  return preorder(diagram).flatMap((id) => {
    if (!drafts.has(id)) return checkNode(diagram, id, vocabulary);
    const note: Problem = { kind: 'draft', severity: 'note', node: id, values: {} };
    return diagram.drafts.includes(id) ? [note] : [];
  });
}
