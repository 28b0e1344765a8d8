import { freshId, type DiagramNode, type NodeId } from './diagram';
import type { Fragment } from './edits';

/**
 * Writes and reads the XML of copied blocks: compact BT.CPP v4, which can be pasted into other tabs, other
 * projects, Groot2 and text editors. Files are written by the translator instead.
 */

const escape = (text: string): string =>
  text
    .replace(/&/g, '&amp;')
    .replace(/</g, '&lt;')
    .replace(/>/g, '&gt;')
    .replace(/"/g, '&quot;')
    .replace(/\n/g, '&#10;')
    .replace(/\t/g, '&#9;');

function attributesOf(node: DiagramNode): [string, string][] {
  return [
    ...(node.tree === undefined ? [] : [['ID', node.tree] as [string, string]]),
    ...(node.name === undefined ? [] : [['name', node.name] as [string, string]]),
    ...Object.entries(node.ports ?? {}),
    ...Object.entries(node.conditions ?? {}),
    ...Object.entries(node.attributes ?? {}),
    ...(node.comment === undefined ? [] : [['_description', node.comment] as [string, string]]),
    ...(node.color === undefined ? [] : [['_bts_color', node.color] as [string, string]]),
    ...(node.disabled ? [['_bts_disabled', '1'] as [string, string]] : []),
    ...(node.collapsed ? [['_bts_collapsed', '1'] as [string, string]] : []),
    ...(node.silenced ? [['_bts_silenced', JSON.stringify(node.silenced)] as [string, string]] : []),
  ];
}

function element({ nodes }: Fragment, id: NodeId, indent: string): string {
  const node = nodes[id];
  if (!node) return '';
  const attributes = attributesOf(node)
    .map(([name, value]) => ` ${name}="${escape(value)}"`)
    .join('');
  const children = node.children ?? [];
  if (children.length === 0) return `${indent}<${node.type}${attributes}/>\n`;
  const inner = children.map((child) => element({ tops: [], nodes }, child, `${indent}  `)).join('');
  return `${indent}<${node.type}${attributes}>\n${inner}${indent}</${node.type}>\n`;
}

export function fragmentToXml(fragment: Fragment): string {
  return fragment.tops.map((top) => element(fragment, top, '')).join('');
}

const CONDITION = /^_(skipIf|failureIf|successIf|while|onSuccess|onFailure|onHalted|post)$/;
const EXPLICIT = new Set(['Action', 'Condition', 'Control', 'Decorator']);
const WRAPPERS = new Set(['root', 'clipboard', 'BehaviorTree']);

/** Reads silenced findings; a text that is not JSON is kept under `?`, as by the translator. */
function readSilenced(text: string): Record<string, string> {
  try {
    const rows: unknown = JSON.parse(text);
    if (
      typeof rows === 'object' &&
      rows !== null &&
      Object.values(rows).every((each) => typeof each === 'string')
    ) {
      return { ...(rows as Record<string, string>) };
    }
  } catch {
    // It is kept as it is.
  }
  return { '?': text };
}

function readElement(xml: Element, nodes: Record<NodeId, DiagramNode>): NodeId {
  const id = freshId(nodes);
  const explicit = EXPLICIT.has(xml.tagName) && xml.hasAttribute('ID');
  const type = explicit ? (xml.getAttribute('ID') ?? '') : xml.tagName;
  const ports: Record<string, string> = {};
  const conditions: Record<string, string> = {};
  const attributes: Record<string, string> = {};
  const rest: { -readonly [K in keyof DiagramNode]?: DiagramNode[K] } = {};
  for (const { name, value } of xml.attributes) {
    if (name === 'ID') {
      if (type === 'SubTree') rest.tree = value;
      else if (!explicit) ports[name] = value;
    } else if (name === 'name') rest.name = value;
    else if (CONDITION.test(name)) conditions[name] = value;
    else if (name === '_description') rest.comment = value;
    else if (name === '_bts_color') rest.color = value;
    else if (name === '_bts_disabled') rest.disabled = true;
    else if (name === '_bts_collapsed') rest.collapsed = true;
    else if (name === '_bts_silenced') rest.silenced = readSilenced(value);
    else if (name === '_bts_id' || name === '_bts_pos' || name === '_bts_skipIf') continue;
    else if (name.startsWith('_')) attributes[name] = value;
    else ports[name] = value;
  }
  nodes[id] = { type };
  const children = [...xml.children].map((child) => readElement(child, nodes));
  nodes[id] = {
    type,
    ...rest,
    ...(Object.keys(ports).length > 0 ? { ports } : {}),
    ...(Object.keys(conditions).length > 0 ? { conditions } : {}),
    ...(Object.keys(attributes).length > 0 ? { attributes } : {}),
    ...(children.length > 0 ? { children } : {}),
  };
  return id;
}

/** Parses copied XML, or a whole BT.CPP document with several trees; null if the text is not XML. */
export function xmlToFragment(text: string): Fragment | null {
  const plain = text.replace(/<\?xml[^>]*\?>/, '').trim();
  if (!plain.startsWith('<') || /<!(DOCTYPE|ENTITY)/i.test(plain)) return null;
  const document = new DOMParser().parseFromString(`<clipboard>${plain}</clipboard>`, 'application/xml');
  if (document.querySelector('parsererror')) return null;
  const nodes: Record<NodeId, DiagramNode> = {};
  const tops: NodeId[] = [];
  const visit = (xml: Element): void => {
    if (xml.tagName === 'TreeNodesModel' || xml.tagName === 'Code') return;
    if (WRAPPERS.has(xml.tagName)) [...xml.children].forEach(visit);
    else tops.push(readElement(xml, nodes));
  };
  visit(document.documentElement);
  return tops.length > 0 ? { tops, nodes } : null;
}
