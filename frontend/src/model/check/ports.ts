import type { DiagramNode, NodeId } from '../diagram';
import { pointerOf, readPortText, type PortSpec } from '../ports';
import { fullName, isRosName, ROS_NAMES, typePortOf } from '../rosFields';
import { fit, outside, partRead, typeLabel } from '../values';
import type { NodeSpec } from '../vocabulary';
import { atPort, type Problem } from './problem';

/** Checks port values, like `translator/check/port.py`. */

const BROKEN = { unclosed: 'unclosed-brace', 'empty-key': 'empty-key', 'bad-key': 'bad-key' } as const;

/** Reports braces that do not form a blackboard key. */
export function checkBraces(id: NodeId, port: string, text: string): Problem[] {
  const value = readPortText(text);
  if (value.kind !== 'broken') return [];
  return [atPort(BROKEN[value.reason], id, port, { text, key: pointerOf(text) ?? '' })];
}

/** Reports a literal that does not match its port's type. */
export function checkLiteral(id: NodeId, { name, type }: PortSpec, text: string): Problem[] {
  const suits = fit(type, text);
  const far = suits === 'range' ? outside(type, text) : null;
  if (far) return [atPort('out-of-range', id, name, { ...far })];
  if (suits === 'bad') return [atPort('wrong-type', id, name, { text, type: typeLabel(type) })];
  const part = partRead(type, text) ?? '';
  return suits === 'loose'
    ? [atPort('read-in-part', id, name, { text, type: typeLabel(type), part }, 'warning')]
    : [];
}

/** Attribute names of XML, without the colon of a namespace. */
const XML_NAME = /^[\p{L}_][\p{L}\p{N}\p{M}._·-]*$/u;

/** Returns whether a port can have this name; names that begin with `_` are reserved for other programs. */
export const isPortName = (name: string): boolean =>
  XML_NAME.test(name) && !name.startsWith('_') && name !== 'name' && name !== 'ID';

/**
 * Returns whether a port may hold a literal: it only reads its value, or the literal is the name of an entry.
 */
const takesLiteral = ({ direction, name }: PortSpec): boolean =>
  direction === 'input' || (direction === 'inout' && (name === 'queue' || name === 'output_key'));

/** Returns whether a port must name an entry: that of a built-in node that watches an entry. */
const namesEntry = ({ name }: PortSpec, { source }: NodeSpec): boolean =>
  name === 'entry' && source === 'builtin';

function checkDeclared(id: NodeId, node: DiagramNode, port: PortSpec, spec: NodeSpec): Problem[] {
  const text = node.ports?.[port.name];
  if (text === undefined || (text === '' && namesEntry(port, spec))) {
    const isMissing = port.required && port.default === null;
    return isMissing ? [atPort('missing-port', id, port.name, { type: port.type })] : [];
  }
  if (port.type === 'script') return [];
  const braces = checkBraces(id, port.name, text);
  if (braces.length > 0 || pointerOf(text) !== null) return braces;
  if (!takesLiteral(port)) return [atPort('output-literal', id, port.name, { text })];
  return checkLiteral(id, port, text);
}

function checkUndeclared(
  id: NodeId,
  name: string,
  text: string,
  node: DiagramNode,
  spec: NodeSpec,
): Problem[] {
  if (!spec.open) return [atPort('unknown-port', id, name, { type: node.type })];
  return isPortName(name) ? checkBraces(id, name, text) : [atPort('bad-port-name', id, name)];
}

/** Reports a type of a ROS node that is not a valid name of a type; only the server knows the installed ones. */
function checkInterface(id: NodeId, node: DiagramNode): Problem[] {
  const typePort = typePortOf(node.type);
  const text = typePort ? node.ports?.[typePort.port] : undefined;
  if (!typePort || !text || pointerOf(text) !== null || fullName(text, typePort.kind) !== null) return [];
  return [atPort('wrong-type', id, typePort.port, { text, type: `package/${typePort.kind}/Name` })];
}

/** Reports a name of a topic, service, action or node that ROS does not take. */
function checkRosNames(id: NodeId, node: DiagramNode): Problem[] {
  if (typePortOf(node.type) === null && node.type !== 'RosParam') return [];
  return Object.entries(ROS_NAMES).flatMap(([port, example]) => {
    const text = node.ports?.[port] ?? '';
    const name = text.trim();
    if (name === '' || pointerOf(text) !== null) return [];
    const isName = isRosName(port === 'node_name' ? name.replace(/\/+$/, '') : name);
    return isName ? [] : [atPort('bad-ros-name', id, port, { text, example })];
  });
}

/** Checks names and values of the ports of a node other than SubTree. */
export function checkPorts(id: NodeId, node: DiagramNode, spec: NodeSpec): Problem[] {
  const declared = new Set(spec.ports.map((port) => port.name));
  return [
    ...checkInterface(id, node),
    ...checkRosNames(id, node),
    ...spec.ports.flatMap((port) => checkDeclared(id, node, port, spec)),
    ...Object.entries(node.ports ?? {})
      .filter(([name]) => !declared.has(name))
      .flatMap(([name, text]) => checkUndeclared(id, name, text, node, spec)),
  ];
}

/** The first typed use of an entry of the blackboard. */
interface Use {
  readonly type: string;
  readonly label: string;
}

const UNTYPED = new Set(['any', 'script', 'status']);

/**
 * Returns a check for the nodes of a tree, to be called in order. It reports entries that ports use with two
 * types.
 */
export function entryCheck(): (id: NodeId, node: DiagramNode, spec: NodeSpec) => Problem[] {
  const entries = new Map<string, Use>();
  const checkEntry = (id: NodeId, node: DiagramNode, port: PortSpec): Problem[] => {
    const text = node.ports?.[port.name] ?? port.default;
    const inner = text === null || UNTYPED.has(port.type) ? null : pointerOf(text);
    if (inner === null) return [];
    const key = inner === '=' ? port.name : inner;
    const first = entries.get(key);
    if (!first) entries.set(key, { type: port.type, label: `${node.name ?? node.type}, ${port.name}` });
    if (!first || first.type === port.type || first.type === 'string') return [];
    return [
      atPort('two-types', id, port.name, {
        key,
        type: typeLabel(port.type),
        otherType: typeLabel(first.type),
        other: first.label,
      }),
    ];
  };
  // SetBlackboard copies a value of any type, although the catalogue declares its port as text.
  return (id, node, spec) =>
    node.type === 'SetBlackboard' ? [] : spec.ports.flatMap((port) => checkEntry(id, node, port));
}
