import { applyPatches, produceWithPatches, type Draft } from 'immer';
import type { Diagram, NodeId } from '../diagram';
import type { UndoEntry, UndoStack } from '../undo';
import { applied } from './apply';
import { operationsBetween } from './between';
import { isSame, placesOf, TREE, valueOf, type Operation } from './operation';

type Diagrams = Readonly<Record<string, Diagram>>;

/** Returns whether a change finds what it changes as its author left it, so that it undoes no work of others. */
function findsItsOwn(changes: readonly Operation[], mine: Diagram, now: Diagram): boolean {
  const mineAt = placesOf(mine);
  const nowAt = placesOf(now);
  const moved = new Set(changes.flatMap((each) => (each.op === 'place' ? [each.id] : [])));
  const removed = new Set(changes.flatMap((each) => (each.op === 'remove' ? [each.id] : [])));
  const created = new Set(changes.flatMap((each) => (each.op === 'create' ? [each.id] : [])));
  const isGone = (id: NodeId) => !created.has(id) && now.nodes[id] === undefined;
  return changes.every((change) => {
    const { op, id } = change;
    if (op === 'create') return now.nodes[id] === undefined;
    if (op === 'set') {
      const [was, is] = id === TREE ? [mine, now] : [mine.nodes[id], now.nodes[id]];
      return was && is && isSame(valueOf(was, change.field), valueOf(is, change.field));
    }
    if (op === 'place') {
      if (typeof change.at === 'object' && isGone(change.at.parent)) return false;
      return created.has(id) || isSame(mineAt.get(id), nowAt.get(id));
    }
    const [was, is] = [mine.nodes[id], now.nodes[id]];
    if (!was || !is) return false;
    const { children: left = [], ...node } = is;
    const { children: _, ...other } = was;
    return isSame(node, other) && left.every((child) => moved.has(child) || removed.has(child));
  });
}

/** Returns `now` after the change from `mine` to `next`; null if that does not apply to it any more. */
export function carried(mine: Diagram, next: Diagram, now: Diagram): Diagram | null {
  if (mine === next || mine === now) return mine === next ? now : next;
  const changes = operationsBetween(mine, next);
  if (!findsItsOwn(changes, mine, now)) return null;
  const { diagram, refused } = applied(now, changes);
  return refused.length === 0 ? diagram : null;
}

function allCarried(mine: Diagrams, next: Diagrams, now: Diagrams): Diagrams | null {
  const found: Record<string, Diagram> = { ...now };
  for (const tree of new Set([...Object.keys(mine), ...Object.keys(next)])) {
    const [from, to, at] = [mine[tree], next[tree], now[tree]];
    if (from === to) continue;
    const step = from && to && at ? carried(from, to, at) : null;
    if (step) found[tree] = step;
    else if (from !== at) return null;
    else if (to) found[tree] = to;
    else Reflect.deleteProperty(found, tree);
  }
  return found;
}

/** Returns the patches between two states, of whole nodes. */
function patchesBetween(before: Diagrams, after: Diagrams) {
  const [, patches, inverse] = produceWithPatches(before, (all) => {
    for (const tree of new Set([...Object.keys(before), ...Object.keys(after)])) {
      const [was, now] = [all[tree], after[tree]];
      if (before[tree] === now) continue;
      if (!now) Reflect.deleteProperty(all, tree);
      else if (!was) all[tree] = now as Draft<Diagram>;
      else replace(was, now);
    }
  });
  return { patches, inverse };
}

function replace(draft: Draft<Diagram>, now: Diagram): void {
  const { nodes, ...fields } = now;
  for (const id of Object.keys(draft.nodes)) if (!(id in nodes)) Reflect.deleteProperty(draft.nodes, id);
  for (const [id, node] of Object.entries(nodes)) {
    if (!isSame(draft.nodes[id], node)) draft.nodes[id] = node as Draft<typeof node>;
  }
  for (const name of Object.keys(draft)) {
    if (name !== 'nodes' && !(name in fields)) Reflect.deleteProperty(draft, name);
  }
  Object.assign(draft, fields);
}

function filesOf({ files = [], renamed }: UndoEntry): string[] {
  const actions = renamed ? [renamed.from, renamed.to] : [];
  return [...files.map(({ path }) => path), ...actions.map((name) => `actions/${name}.py`)];
}

interface Walk {
  readonly entries: UndoEntry[];
  /** How many steps do not apply any more. */
  readonly lost: number;
}

function walked(
  entries: readonly UndoEntry[],
  way: 'inverse' | 'patches',
  mine: Diagrams,
  now: Diagrams,
  isTheirs: (path: string) => boolean,
): Walk {
  const found: UndoEntry[] = [];
  let [from, at] = [mine, now];
  for (const entry of entries) {
    let to: Diagrams;
    try {
      to = applyPatches(from, entry[way]);
    } catch {
      break; // a step of another tree has removed what this one and those behind it change
    }
    const next = filesOf(entry).some(isTheirs) ? null : allCarried(from, to, at);
    if (next) {
      const { patches, inverse } = patchesBetween(at, next);
      found.push({
        ...entry,
        ...(way === 'patches' ? { patches, inverse } : { patches: inverse, inverse: patches }),
      });
      at = next;
    }
    from = to;
  }
  return { entries: found, lost: entries.length - found.length };
}

export interface Carried {
  readonly undoStack: UndoStack;
  readonly lost: number;
}

/**
 * Returns an undo stack of trees that others have changed. Each step that still applies stays: it finds what it
 * changes as its author left it. The others are lost, since they would revert the work of others.
 *
 * @param mine The trees before the change of others, on which the stack was made.
 * @param now The trees after it.
 * @param isTheirs Whether others have changed a file.
 */
export function carriedStack(
  { past, future }: UndoStack,
  mine: Diagrams,
  now: Diagrams,
  isTheirs: (path: string) => boolean,
): Carried {
  const back = walked([...past].reverse(), 'inverse', mine, now, isTheirs);
  const forth = walked(future, 'patches', mine, now, isTheirs);
  return {
    undoStack: { past: back.entries.reverse(), future: forth.entries, sealed: true },
    lost: back.lost + forth.lost,
  };
}
