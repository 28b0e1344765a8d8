import { subtreeOf, type Diagram, type DiagramNode, type NodeId } from '../diagram';
import { pointerOf, readPortText, type PortSpec } from '../ports';
import { fullName, isRosName, ROS_NAMES, typePortOf } from '../rosFields';
import { fit, outside, partRead } from '../values';
import { passedBy, treeFacts } from '../treeFacts';
import type { NodeSpec, Vocabulary } from '../vocabulary';
import { atPort, type Problem } from './problem';

/** Checks port values, like `translator/check/port.py`. */

const BROKEN = { unclosed: 'unclosed-brace', 'empty-key': 'empty-key', 'bad-key': 'bad-key' } as const;

/** Reports braces that do not form a blackboard key; they are a text where the port takes any text. */
export function checkBraces(id: NodeId, port: string, text: string, isText = true): Problem[] {
  const value = readPortText(text);
  if (value.kind !== 'broken') return [];
  const key = pointerOf(text) ?? '';
  const isTaken = value.reason === 'bad-key' ? !/^@.*@/s.test(key) : isText;
  return [atPort(BROKEN[value.reason], id, port, { text, key }, isTaken ? 'warning' : 'error')];
}

/** Reports a literal that does not match its port's type. */
export function checkLiteral(id: NodeId, { name, type }: PortSpec, text: string): Problem[] {
  const suits = fit(type, text);
  const far = suits === 'range' ? outside(type, text) : null;
  if (far) return [atPort('out-of-range', id, name, { ...far })];
  if (suits === 'bad') return [atPort('wrong-type', id, name, { text, valueType: type })];
  const part = partRead(type, text) ?? '';
  return suits === 'loose'
    ? [atPort('read-in-part', id, name, { text, valueType: type, part }, 'warning')]
    : [];
}

/** Attribute names of XML that begin with a plain letter, without colon and point. */
const PORT_NAME = /^[A-Za-z][\p{L}\p{N}\p{M}_·-]*$/u;

/** Returns whether the engine reads an attribute as a port; it ignores others. */
export const isPortName = (name: string): boolean => PORT_NAME.test(name) && name !== 'name' && name !== 'ID';

/**
 * Returns whether a port may hold a literal: it only reads its value, or the literal is the name of an entry.
 */
const takesLiteral = ({ direction, name }: PortSpec): boolean =>
  direction === 'input' || (direction === 'inout' && (name === 'queue' || name === 'output_key'));

/** Returns whether a port must name an entry: that of a built-in node that watches an entry. */
const namesEntry = ({ name }: PortSpec, { source }: NodeSpec): boolean =>
  name === 'entry' && source === 'builtin';

const isQueue = ({ direction, name, type }: PortSpec): boolean =>
  direction === 'inout' && name === 'queue' && type.startsWith('list[');

/** Reports blanks round a key where a port reads the whole as a literal. */
function checkBlanks(id: NodeId, port: PortSpec, text: string): Problem[] {
  const { name, type } = port;
  const isRefused = type !== 'status' && !isQueue(port) && fit(type, text) === 'bad';
  return isRefused && /^ | $/.test(text) ? [atPort('wrong-type', id, name, { text, valueType: type })] : [];
}

function checkDeclared(id: NodeId, node: DiagramNode, port: PortSpec, spec: NodeSpec): Problem[] {
  const text = node.ports?.[port.name];
  if (text === undefined || (text === '' && namesEntry(port, spec))) {
    const isMissing = port.required && port.default === null;
    const kind = port.direction === 'output' ? 'missing-key' : 'missing-port';
    return isMissing ? [atPort(kind, id, port.name, { valueType: port.type })] : [];
  }
  if (port.type === 'script') return [];
  const isText = takesLiteral(port) && fit(port.type, text) === 'good';
  const braces = checkBraces(id, port.name, text, isText);
  if (braces.length > 0) return braces;
  if (pointerOf(text) !== null) return checkBlanks(id, port, text);
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
  if (!isPortName(name)) return [atPort('bad-port-name', id, name, {}, 'warning')];
  if (!spec.open) return [atPort('unknown-port', id, name, { type: node.type })];
  return checkBraces(id, name, text);
}

/** Reports a type of a ROS node that is not a valid name of a type; only the server knows the installed ones. */
function checkInterface(id: NodeId, node: DiagramNode): Problem[] {
  const typePort = typePortOf(node.type);
  const text = typePort ? node.ports?.[typePort.port] : undefined;
  if (!typePort || !text || pointerOf(text) !== null || fullName(text, typePort.kind) !== null) return [];
  return [atPort('wrong-type', id, typePort.port, { text, valueType: `package/${typePort.kind}/Name` })];
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

/** The first use of an entry of the blackboard; its type is empty if it fixes none. */
interface Use {
  readonly type: string;
  readonly label: string;
}

/** Returns the type that a port gives to its entry; empty if any. */
function entryType(port: PortSpec): string {
  if (isQueue(port) || port.type === 'any') return '';
  return port.type === 'script' ? 'string' : port.type;
}

function agrees(first: string, port: PortSpec): boolean {
  if (isQueue(port)) return first === 'string' || first === port.type;
  return first === 'string' || first === entryType(port);
}

function outerNames(node: DiagramNode): string[] {
  return Object.entries(node.ports ?? {}).flatMap(([name, text]) => {
    const key = pointerOf(text);
    return key === null ? [] : [key === '=' ? name : key];
  });
}

/** Returns whether other trees may use an entry of a tree: then only the server judges its type. */
function sharing(diagram: Diagram, vocabulary: Vocabulary): (key: string) => boolean {
  const ids = diagram.root === null ? [] : subtreeOf(diagram, diagram.root);
  const calls = ids.flatMap((id) => {
    const node = diagram.nodes[id];
    return node?.type === 'SubTree' ? [node] : [];
  });
  const own = treeFacts(diagram);
  const given = [own, ...vocabulary.trees.values()].map(({ passed }) => passed.get(diagram.id));
  const names = new Set([...own.ports.map(({ name }) => name), ...calls.flatMap(outerNames)]);
  const all = given.includes(null) || calls.some((node) => passedBy(node) === null);
  return (key) =>
    all || key.startsWith('@') || names.has(key) || given.some((each) => each?.has(key) === true);
}

/**
 * Returns a check of the entries of one tree: two ports of different types cannot lead to one. The first port
 * in the order of execution decides, like `translator/check/entry_types.py`.
 */
export function entryCheck(
  diagram: Diagram,
  vocabulary: Vocabulary,
): (id: NodeId, node: DiagramNode, spec: NodeSpec) => Problem[] {
  const entries = new Map<string, Use>();
  const isShared = sharing(diagram, vocabulary);
  const checkEntry = (id: NodeId, node: DiagramNode, port: PortSpec, text: string): Problem[] => {
    const inner = pointerOf(text);
    if (inner === null) return [];
    const key = inner === '=' ? port.name : inner;
    const first = entries.get(key);
    if (!first) entries.set(key, { type: entryType(port), label: `${node.name ?? node.type}, ${port.name}` });
    if (!first || first.type === '' || isShared(key)) return [];
    if ((entryType(port) === '' && !isQueue(port)) || agrees(first.type, port)) return [];
    return [
      atPort(
        'two-types',
        id,
        port.name,
        { key, valueType: port.type, otherType: first.type, other: first.label },
        isQueue(port) ? 'warning' : 'error',
      ),
    ];
  };
  return (id, node, spec) =>
    spec.open
      ? []
      : Object.entries(node.ports ?? {}).flatMap(([name, text]) => {
          const port = spec.ports.find((each) => each.name === name);
          return port ? checkEntry(id, node, port, text) : [];
        });
}
