import {
  isMap,
  isScalar,
  isSeq,
  parseDocument,
  type Document,
  type Node,
  type Pair,
  type YAMLMap,
  type YAMLSeq,
} from 'yaml';
import { applyOps, sameValue, type Op } from './ops';
import { parsed, YAML_OPTIONS } from './yaml';
import { splicedAll, type Splice } from './splice';
import { isObject, type Json, type Path } from './values';
import { blockItem, blockPair, inline, keyText } from './write';

/** Thrown for a document that cannot be changed piece by piece because of its style. */
export class UnwritableError extends Error {}

/**
 * Changes a document's text. In a document of the usual style, unchanged parts stay the same byte by byte;
 * any other document is written again, with its comments and order.
 */
export function rewrite(text: string, ops: readonly Op[]): string {
  const document = parse(text);
  const raw = document.toJS() as Json;
  if (!isObject(raw)) throw new UnwritableError('the document is no mapping');
  const wanted = applyOps(raw, ops);
  for (const write of [bySplices, byDocument]) {
    const written = write(text, ops);
    if (written !== null && says(written, wanted)) return written;
  }
  throw new UnwritableError('the document cannot be changed piece by piece');
}

const parse = (text: string): Document => parsed(text).document;

function says(text: string, wanted: Json): boolean {
  const document = parse(text);
  return document.errors.length === 0 && sameValue(document.toJS() as Json, wanted);
}

/** Applies operations together if they do not overlap, since each pass must parse the text. */
function bySplices(text: string, ops: readonly Op[]): string | null {
  let now = text;
  let waiting: Splice[] = [];
  const flush = () => {
    if (waiting.length === 0) return;
    now = splicedAll(now, waiting);
    waiting = [];
  };
  for (const op of ops) {
    const isInPlace = op.kind === 'set' && parse(now).hasIn(op.path);
    if (!isInPlace) flush();
    const splices = splicesOf(now, parse(now), op);
    if (splices === null) return null;
    if (splices.some((splice) => waiting.some((other) => overlaps(splice, other)))) return null;
    waiting.push(...splices);
    if (!isInPlace) flush();
  }
  flush();
  return now;
}

const overlaps = (a: Splice, b: Splice): boolean =>
  a.at < b.at + b.removed.length && b.at < a.at + a.removed.length;

function splicesOf(text: string, document: Document, op: Op): Splice[] | null {
  if (op.kind === 'set') return setSplices(text, document, op.path, op.value);
  if (op.kind === 'unset') return unsetSplices(text, document, op.path);
  if (op.kind === 'rename') return renameSplices(text, document, op.path, op.to);
  const list = nodeAt(document, op.path);
  if (!isSeq(list)) return null;
  if (op.kind === 'insert') return insertSplices(text, list, op.index, op.values);
  return removeSplices(text, list.items as Node[], new Set(op.indexes), list);
}

function nodeAt(document: Document, path: Path): Node | null {
  return (path.length === 0 ? document.contents : document.getIn(path, true)) as Node | null;
}

const cut = (text: string, start: number, end: number, inserted = ''): Splice => ({
  at: start,
  removed: text.slice(start, end),
  inserted,
});

function setSplices(text: string, document: Document, path: Path, value: Json): Splice[] | null {
  const node = nodeAt(document, path);
  if (node?.range) return replaceSplices(text, node, value);
  const parent = nodeAt(document, path.slice(0, -1));
  const key = path.at(-1);
  return isMap(parent) && typeof key === 'string' && !parent.has(key)
    ? addSplices(text, parent, key, value)
    : null;
}

function replaceSplices(text: string, node: Node, value: Json): Splice[] | null {
  const [start, end] = node.range ?? [0, 0];
  if (isSeq(node) && Array.isArray(value) && node.items.length === value.length && value.length > 0) {
    // Each number is changed alone, so that unchanged ones keep their notation.
    const parts = (value as Json[]).map((part, index) => {
      const own = node.items[index] as Node;
      return isScalar(own) && own.value === part ? [] : replaceSplices(text, own, part);
    });
    return parts.every((part) => part !== null) ? parts.flat() : null;
  }
  const isOnOneLine = isScalar(node)
    ? node.type !== 'BLOCK_LITERAL' && node.type !== 'BLOCK_FOLDED'
    : isFlow(node);
  if (!isOnOneLine || start === end) return null;
  return [cut(text, start, end, inline(value))];
}

const isFlow = (node: unknown): boolean => (isMap(node) || isSeq(node)) && node.flow === true;

/** Returns the end of a node's last written part. */
function endOf(node: Node | null): number | null {
  if (isMap(node) && !isFlow(node)) return endOf((node.items.at(-1)?.value ?? null) as Node | null);
  if (isSeq(node) && !isFlow(node)) return endOf((node.items.at(-1) ?? null) as Node | null);
  const [start, end] = node?.range ?? [0, 0];
  return end > start ? end : null;
}

/** Returns the end of the line that contains a position, its comment included. */
function lineEnd(text: string, at: number): number {
  const end = text.indexOf('\n', at);
  return end < 0 ? text.length : end;
}

const lineStart = (text: string, at: number): number => text.lastIndexOf('\n', at - 1) + 1;

function addSplices(text: string, map: YAMLMap, key: string, value: Json): Splice[] | null {
  const last = map.items.at(-1) as Pair<Node, Node | null> | undefined;
  const [start, end] = map.range ?? [0, 0];
  if (!last) return isFlow(map) ? [cut(text, start, end, `{${keyText(key)}: ${inline(value)}}`)] : null;
  const after = endOf(last.value);
  if (after === null) return null;
  if (isFlow(map)) return [cut(text, after, after, `, ${keyText(key)}: ${inline(value)}`)];
  const first = (map.items[0]?.key as Node).range?.[0] ?? 0;
  const column = first - lineStart(text, first);
  const at = text[after - 1] === '\n' ? after - 1 : lineEnd(text, after);
  return [cut(text, at, at, `\n${blockPair(key, value, ' '.repeat(column))}`)];
}

function unsetSplices(text: string, document: Document, path: Path): Splice[] | null {
  const parent = nodeAt(document, path.slice(0, -1));
  if (!isMap(parent)) return null;
  const index = parent.items.findIndex(({ key }) => isScalar(key) && key.value === path.at(-1));
  const pair = parent.items[index] as Pair<Node, Node | null> | undefined;
  const start = pair?.key.range?.[0];
  const end = endOf(pair?.value ?? null);
  if (parent.items.length < 2 || start === undefined || end === null) return null;
  if (!isFlow(parent)) return wholeLines(text, start, end);
  const next = (parent.items[index + 1]?.key as Node | undefined)?.range?.[0];
  if (next !== undefined) return [cut(text, start, next)];
  const before = endOf((parent.items[index - 1]?.value ?? null) as Node | null);
  return before === null ? null : [cut(text, before, end)];
}

const pairAt = (map: YAMLMap, key: string | number | undefined) =>
  (map.items as Pair<Node, Node | null>[]).find(({ key: own }) => isScalar(own) && own.value === key);

function renameSplices(text: string, document: Document, path: Path, to: string): Splice[] | null {
  const parent = nodeAt(document, path.slice(0, -1));
  const [start, end] = (isMap(parent) && pairAt(parent, path.at(-1))?.key.range) || [0, 0];
  return end > start ? [cut(text, start, end, keyText(to))] : null;
}

/** Cuts the whole lines from one position to another; null if something else starts on the first line. */
function wholeLines(text: string, start: number, end: number): Splice[] | null {
  const from = lineStart(text, start);
  if (!/^\s*(- +)?$/.test(text.slice(from, start))) return null;
  if (text[end - 1] === '\n') return [cut(text, from, end)];
  const to = lineEnd(text, end);
  return [to < text.length ? cut(text, from, to + 1) : cut(text, Math.max(from - 1, 0), to)];
}

function insertSplices(text: string, list: YAMLSeq, index: number, values: readonly Json[]): Splice[] | null {
  const items = list.items as Node[];
  const [start, end] = list.range ?? [0, 0];
  if (items.length === 0) {
    const from = lineStart(text, start);
    const margin = /^ */.exec(text.slice(from))?.[0] ?? '';
    const before = text.slice(0, start).trimEnd().length;
    return [
      cut(text, before, end, `\n${values.map((value) => blockItem(value, `${margin}  `, false)).join('\n')}`),
    ];
  }
  const neighbour = items[Math.max(index - 1, 0)];
  const from = neighbour?.range?.[0];
  const after = endOf(neighbour ?? null);
  if (!neighbour || from === undefined || after === null) return null;
  if (isFlow(list)) {
    const written = values.map(inline).join(', ');
    return [index === 0 ? cut(text, from, from, `${written}, `) : cut(text, after, after, `, ${written}`)];
  }
  const dash = /^( *)- +$/.exec(text.slice(lineStart(text, from), from));
  if (!dash) return null;
  const isLong = isMap(neighbour) && !isFlow(neighbour);
  const written = values.map((value) => blockItem(value, dash[1] ?? '', isLong)).join('\n');
  if (index === 0) return [cut(text, lineStart(text, from), lineStart(text, from), `${written}\n`)];
  const at = text[after - 1] === '\n' ? after - 1 : lineEnd(text, after);
  return [cut(text, at, at, `\n${written}`)];
}

function removeSplices(
  text: string,
  items: readonly Node[],
  indexes: ReadonlySet<number>,
  list: YAMLSeq,
): Splice[] | null {
  const gone = [...indexes].sort((a, b) => a - b);
  const [start, end] = list.range ?? [0, 0];
  if (isFlow(list)) {
    const left = items
      .filter((_, index) => !indexes.has(index))
      .map(({ range }) => text.slice(range?.[0], range?.[1]));
    return [cut(text, start, end, `[${left.join(', ')}]`)];
  }
  const splices: Splice[] = [];
  for (const index of gone) {
    const from = items[index]?.range?.[0];
    const to = endOf(items[index] ?? null);
    const lines = from === undefined || to === null ? null : wholeLines(text, from, to);
    if (!lines) return null;
    splices.push(...lines);
  }
  if (gone.length < items.length) return splices;
  const colon = text.lastIndexOf(':', start);
  return text.slice(colon, start).includes('\n')
    ? [cut(text, colon + 1, colon + 1, ' []'), ...splices]
    : null;
}

/** Writes the document with the YAML library: comments and order stay, spaces and line breaks may change. */
function byDocument(text: string, ops: readonly Op[]): string | null {
  const document = parseDocument(text, YAML_OPTIONS);
  const made = (value: Json) => {
    const node = document.createNode(value);
    if (isMap(node) || isSeq(node)) node.flow = true;
    return node;
  };
  try {
    for (const op of ops) {
      if (op.kind === 'set') document.setIn(op.path, made(op.value));
      else if (op.kind === 'unset') document.deleteIn(op.path);
      else if (op.kind === 'rename') {
        const map = nodeAt(document, op.path.slice(0, -1));
        const pair = isMap(map) ? pairAt(map, op.path.at(-1)) : undefined;
        if (pair) pair.key = made(op.to) as Node;
      } else {
        const list = nodeAt(document, op.path);
        if (op.kind === 'insert' && !isSeq(list)) document.setIn(op.path, document.createNode(op.values));
        else if (isSeq(list) && op.kind === 'insert') list.items.splice(op.index, 0, ...op.values.map(made));
        else if (isSeq(list) && op.kind === 'remove') {
          list.items = list.items.filter((_, index) => !op.indexes.includes(index));
          if (list.items.length === 0) list.flow = true;
        }
      }
    }
    return document.toString({ lineWidth: 0, flowCollectionPadding: false });
  } catch {
    return null;
  }
}
