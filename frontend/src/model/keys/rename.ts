import type { Diagram, NodeId } from '../diagram';
import { setCondition, setPort, type Recipe } from '../edits';
import { treeFacts } from '../treeFacts';
import type { Vocabulary } from '../vocabulary';
import { hasAutoremap, scopeOf, SHARED, type Board, type Forest } from './scope';
import { keysOf, usesIn, withKeys, type Use } from './uses';

/** A key on a blackboard; several blackboards may share its entry (`scopeOf`). */
export interface Key {
  readonly board: Board;
  readonly name: string;
}

/** Returns the key that a text in a tree names; `@` marks a shared key. */
export const keyOf = (tree: string, written: string): Key =>
  written.startsWith('@') ? { board: SHARED, name: written.slice(1) } : { board: tree, name: written };

/** One text or name that changes. */
export interface KeyChange {
  readonly tree: string;
  /** null: the change is in a port that the tree declares. */
  readonly node: NodeId | null;
  readonly part: 'port' | 'condition' | 'portName' | 'declared';
  readonly name: string;
  readonly before: string;
  readonly after: string;
}

export type Refusal = 'same' | 'not-a-name' | 'taken';

export interface RenamePlan {
  readonly scope: ReadonlySet<Board>;
  readonly changes: readonly KeyChange[];
  /** Scripts with a syntax error, which may name the key. */
  readonly unread: readonly { readonly tree: string; readonly node: NodeId; readonly text: string }[];
  readonly refusal: Refusal | null;
}

const RESERVED = new Set(['name', 'ID', 'true', 'false']);

/**
 * Returns whether a key can get a name that scripts and ports of a SubTree accept. A name with `_` is
 * private: a private key stays private, and any other does not become private.
 */
const isName = (to: string, from: string): boolean =>
  /^[A-Za-z_][A-Za-z0-9_]*$/.test(to) && !RESERVED.has(to) && to.startsWith('_') === from.startsWith('_');

/** Returns all keys of the trees, each entry once: on the first blackboard that uses it. */
export function allKeys(forest: Forest, vocabulary: Vocabulary): Key[] {
  const found: (Key & { scope: ReadonlySet<Board> })[] = [];
  for (const [tree, diagram] of Object.entries(forest.diagrams)) {
    for (const written of new Set(usesIn(diagram, forest, vocabulary).flatMap(keysOf))) {
      const { board, name } = keyOf(tree, written);
      if (found.some((other) => other.name === name && other.scope.has(board))) continue;
      found.push({ board, name, scope: scopeOf(forest, board, name) });
    }
  }
  return found
    .map(({ board, name }) => ({ board, name }))
    .sort((a, b) => a.name.localeCompare(b.name) || a.board.localeCompare(b.board));
}

/** Returns whether a key is used on a blackboard, or passed to its tree. */
function isUsed(forest: Forest, vocabulary: Vocabulary, board: Board, name: string): boolean {
  const scope = scopeOf(forest, board, name);
  return Object.entries(forest.diagrams).some(([tree, diagram]) => {
    const names = new Set(usesIn(diagram, forest, vocabulary).flatMap(keysOf));
    const isDeclared = treeFacts(diagram).ports.some((port) => port.name === name);
    const isPassed = Object.values(diagram.nodes).some(
      ({ type, tree: called, ports }) =>
        type === 'SubTree' && scope.has(called ?? '') && ports?.[name] !== undefined,
    );
    return (
      (scope.has(tree) && (names.has(name) || isDeclared)) ||
      (scope.has(SHARED) && names.has(`@${name}`)) ||
      isPassed
    );
  });
}

/** Returns all changes that the renaming of a key needs in all trees, or the reason of a refusal. */
export function planRename(forest: Forest, vocabulary: Vocabulary, key: Key, to: string): RenamePlan {
  const { name: from } = key;
  const scope = scopeOf(forest, key.board, from);
  const changes: KeyChange[] = [];
  const unread: { tree: string; node: NodeId; text: string }[] = [];
  for (const [tree, diagram] of Object.entries(forest.diagrams)) {
    const rename = (name: string): string => {
      if (name === from && scope.has(tree)) return to;
      return name === `@${from}` && scope.has(SHARED) ? `@${to}` : name;
    };
    for (const use of usesIn(diagram, forest, vocabulary)) {
      const after = isPassedOn(diagram, use, scope) ? use.text : withKeys(use, rename);
      const { node, part, name, text: before } = use;
      if (after === null) {
        if (scope.has(tree) && before.includes(from)) unread.push({ tree, node, text: before });
      } else if (after !== before) changes.push({ tree, node, part, name, before, after });
    }
    changes.push(...portNames(tree, diagram, from, to, scope));
  }
  return { scope, changes, unread, refusal: refusalOf(forest, vocabulary, key, to, scope) };
}

/**
 * Returns whether a SubTree passes a key by `{=}` to a tree where the key is renamed too: then the text
 * stays.
 */
function isPassedOn(diagram: Diagram, { node: id, name, text }: Use, scope: ReadonlySet<Board>): boolean {
  const node = diagram.nodes[id];
  const isSame = node?.type === 'SubTree' && node.ports?.[name] === text && text.trim() === '{=}';
  return isSame && scope.has(node.tree ?? '');
}

/** Returns the changes of names of ports: those that the tree declares, and those that its SubTrees pass. */
function portNames(
  tree: string,
  diagram: Diagram,
  from: string,
  to: string,
  scope: ReadonlySet<Board>,
): KeyChange[] {
  const change = { tree, name: from, before: from, after: to };
  const isDeclared = scope.has(tree) && treeFacts(diagram).ports.some(({ name }) => name === from);
  const declared = isDeclared ? [{ ...change, node: null, part: 'declared' as const }] : [];
  const passed = Object.entries(diagram.nodes).flatMap(([node, { type, tree: called, ports }]) =>
    type === 'SubTree' && scope.has(called ?? '') && ports?.[from] !== undefined
      ? [{ ...change, node, part: 'portName' as const }]
      : [],
  );
  return [...declared, ...passed];
}

function refusalOf(
  forest: Forest,
  vocabulary: Vocabulary,
  { name }: Key,
  to: string,
  scope: ReadonlySet<Board>,
): Refusal | null {
  if (to === name) return 'same';
  if (!isName(to, name)) return 'not-a-name';
  return [...scope].some((board) => isUsed(forest, vocabulary, board, to)) ? 'taken' : null;
}

const renamedRow = (row: unknown, from: string, to: string): unknown =>
  typeof row === 'object' && row !== null && 'name' in row && row.name === from ? { ...row, name: to } : row;

/** Returns the trees where a SubTree passes the key by `_autoremap`, without naming it. */
export const carriedBy = (forest: Forest, { scope }: RenamePlan): string[] =>
  Object.entries(forest.diagrams).flatMap(([tree, { nodes }]) =>
    scope.has(tree) && Object.values(nodes).some((node) => hasAutoremap(node) && scope.has(node.tree ?? ''))
      ? [tree]
      : [],
  );

/** Returns the edits that make the changes of a plan in one tree. */
export function applyChanges(tree: string, { changes }: RenamePlan): Recipe[] {
  const own = changes.filter((change) => change.tree === tree);
  const texts = own.flatMap(({ node, part, name, after }) => {
    if (node === null) return [];
    if (part === 'port') return [setPort(node, name, after)];
    return part === 'condition' ? [setCondition(node, name, after)] : [];
  });
  const names = own.map(({ node: id, part, before, after }): Recipe => (draft) => {
    if (part === 'declared' && Array.isArray(draft.ports)) {
      draft.ports = draft.ports.map((row: unknown) => renamedRow(row, before, after));
    }
    const node = part === 'portName' ? draft.nodes[id ?? ''] : undefined;
    if (!node?.ports) return;
    const entries = Object.entries(node.ports);
    node.ports = Object.fromEntries(entries.map(([name, text]) => [name === before ? after : name, text]));
  });
  return [...texts, ...names];
}

/** Returns the lines of Python that contain a key as a string: they are not changed, but may mean the key. */
export function linesToLookAt(
  texts: Readonly<Record<string, string>>,
  name: string,
): { path: string; line: number; text: string }[] {
  const quoted = [`'${name}'`, `"${name}"`, `'@${name}'`, `"@${name}"`];
  return Object.entries(texts).flatMap(([path, text]) =>
    text.split(/\r\n?|\n/).flatMap((line, index) => {
      const isMeant = path.endsWith('.py') && quoted.some((each) => line.includes(each));
      return isMeant ? [{ path, line: index + 1, text: line.trim() }] : [];
    }),
  );
}
