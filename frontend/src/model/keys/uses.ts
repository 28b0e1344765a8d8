import { preorder, type Diagram, type DiagramNode, type NodeId } from '../diagram';
import { readPortText } from '../ports';
import { treeFacts } from '../treeFacts';
import { specOf, type Vocabulary } from '../vocabulary';
import { keysInScript, renameInScript } from './script';
import { hasAutoremap, passedFor, type Forest } from './scope';

/** A text of a block that can name keys, and the way to read them. */
export interface Use {
  readonly node: NodeId;
  readonly part: 'port' | 'condition';
  readonly name: string;
  readonly text: string;
  readonly reads: 'pointer' | 'script' | 'key';
}

/** Ports whose literal is the name of an entry. */
const NAMES_ENTRY = new Set([
  'SetBlackboard output_key',
  'UnsetBlackboard key',
  'SkipUnlessUpdated entry',
  'WaitValueUpdate entry',
  'WasEntryUpdated entry',
]);

/** Returns the texts of a block's ports, with the default of each port that is not set. */
function portsOf(node: DiagramNode, { diagrams }: Forest, vocabulary: Vocabulary): [string, string][] {
  const set = Object.entries(node.ports ?? {}).filter(([name]) => name !== '_autoremap');
  const given = new Set(set.map(([name]) => name));
  const called = node.type === 'SubTree' ? diagrams[node.tree ?? ''] : undefined;
  const declared = called && !hasAutoremap(node) ? treeFacts(called).ports : specOf(vocabulary, node)?.ports;
  const defaults = (declared ?? []).flatMap(({ name, default: text }): [string, string][] =>
    text === null || given.has(name) ? [] : [[name, passedFor(node, name, called) ?? text]],
  );
  return [...set, ...defaults.filter(([, text]) => readPortText(text).kind !== 'literal')];
}

/** Returns all texts of a tree that can name keys, in execution order. */
export function usesIn(diagram: Diagram, forest: Forest, vocabulary: Vocabulary): Use[] {
  return preorder(diagram).flatMap((id): Use[] => {
    const node = diagram.nodes[id];
    if (!node) return [];
    const spec = specOf(vocabulary, node);
    const ports = portsOf(node, forest, vocabulary).map(([name, text]): Use => {
      const type = spec?.ports.find((port) => port.name === name)?.type;
      const isLiteral = readPortText(text).kind === 'literal';
      const reads =
        isLiteral && type === 'script'
          ? 'script'
          : isLiteral && NAMES_ENTRY.has(`${node.type} ${name}`)
            ? 'key'
            : 'pointer';
      return { node: id, part: 'port', name, text, reads };
    });
    const conditions = Object.entries(node.conditions ?? {}).map(([name, text]): Use => ({
      node: id,
      part: 'condition',
      name,
      text,
      reads: 'script',
    }));
    return [...ports, ...conditions];
  });
}

/** Returns the keys that a text names, `@` included. */
export function keysOf({ text, name, reads }: Use): string[] {
  if (reads === 'script') return keysInScript(text);
  if (reads === 'key') return [text.trim()];
  const value = readPortText(text);
  if (value.kind === 'same-name') return [name];
  return value.kind === 'key' ? [value.global ? `@${value.key}` : value.key] : [];
}

/** Returns a text with its keys renamed; null for a script with an invalid character. */
export function withKeys(use: Use, rename: (key: string) => string): string | null {
  const { text, reads } = use;
  if (reads === 'script') return renameInScript(text, rename);
  const [key] = keysOf(use);
  if (key === undefined || rename(key) === key) return text;
  return reads === 'key' ? rename(key) : text.replace(/\{[^}]*\}/, `{${rename(key)}}`);
}
