import type { DiagramNode, NodeId } from '../diagram';
import { pointerOf, type PortSpec } from '../ports';
import type { Vocabulary } from '../vocabulary';
import { closingCalls } from './rings';
import { checkBraces, checkLiteral, isPortName } from './ports';
import { atPort, type Problem } from './problem';

/** Checks SubTree nodes, like `translator/check/subtree.py`. */

const AUTOREMAP = '_autoremap';
const SWITCHES = new Set(['0', '1', 'true', 'false', 'True', 'False', 'TRUE', 'FALSE']);

function checkValue(id: NodeId, port: PortSpec, text: string): Problem[] {
  if (pointerOf(text) !== null) return [];
  if (port.type === 'double' && /^-?[0-9]+$/.test(text)) {
    // A SubTree stores the number that it passes as a typed entry, and an int entry is not a double.
    return [atPort('whole-for-double', id, port.name, { text }, 'warning')];
  }
  return port.direction === 'input' ? checkLiteral(id, port, text) : [];
}

function checkPort(id: NodeId, name: string, text: string, declared: PortSpec | undefined): Problem[] {
  const named = isPortName(name) ? [] : [atPort('bad-port-name', id, name, {}, 'warning')];
  const braces = checkBraces(id, name, text);
  return [...named, ...braces, ...(declared && braces.length === 0 ? checkValue(id, declared, text) : [])];
}

/** Checks the ports that a SubTree passes to its tree. */
function checkGiven(id: NodeId, node: DiagramNode, ports: readonly PortSpec[]): Problem[] {
  const { [AUTOREMAP]: asPort, ...given } = node.ports ?? {};
  const autoremap = asPort ?? node.attributes?.[AUTOREMAP];
  const found = Object.entries(given).flatMap(([name, text]) =>
    checkPort(
      id,
      name,
      text,
      ports.find((port) => port.name === name),
    ),
  );
  if (autoremap !== undefined && !SWITCHES.has(autoremap)) {
    found.push({ kind: 'bad-autoremap', severity: 'error', node: id, values: { text: autoremap } });
  }
  if (/^(?:true|1)$/i.test(autoremap ?? '')) return found;
  const missing = ports.filter((port) => !(port.name in given) && !port.default);
  return [
    ...found,
    ...missing.map((port) => atPort('missing-tree-port', id, port.name, { tree: node.tree ?? '' })),
  ];
}

function checkCall(id: NodeId, node: DiagramNode, closesRing: boolean, vocabulary: Vocabulary): Problem[] {
  const base = { severity: 'error', node: id, values: { tree: node.tree ?? '' } } as const;
  if (!node.tree) return [{ ...base, kind: 'missing-tree' }];
  const called = vocabulary.trees.get(node.tree);
  if (!called) return [{ ...base, kind: 'unknown-tree' }];
  const recursion: Problem[] = closesRing ? [{ ...base, kind: 'recursion' }] : [];
  return [...recursion, ...checkGiven(id, node, called.ports)];
}

/** Returns a check for the SubTree nodes of one tree. It reports names that two of them share. */
export function callCheck(
  user: string,
  vocabulary: Vocabulary,
): (id: NodeId, node: DiagramNode) => Problem[] {
  const names = new Set<string>();
  const closing = new Set([user, ...(closingCalls(vocabulary).get(user) ?? [])]);
  return (id, node) => {
    const name = node.name ?? '';
    const isTaken = name !== '' && names.has(name);
    names.add(name);
    const taken: Problem[] = isTaken
      ? [{ kind: 'same-call-name', severity: 'error', node: id, values: { name } }]
      : [];
    const closesRing = closing.delete(node.tree ?? '');
    return [...checkCall(id, node, closesRing, vocabulary), ...taken];
  };
}
