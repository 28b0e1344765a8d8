import { parseDiagram, serializeDiagram } from './serialize';
import type { Diagram, DiagramNode } from './diagram';

/** The contents of files, by path. */
export type Sources = Readonly<Record<string, string>>;

/** The result of adding a behaviour to a project. */
export interface Insertion {
  /** The tree to call, by its name in the project. */
  readonly tree: string;
  /** The files to write, by path, without those that already have the same content. */
  readonly files: Sources;
  /** The path in the project of each file of the behaviour. */
  readonly places: Readonly<Record<string, string>>;
}

const ACTION = /^actions\/([^/]+)\.py$/;
const TREE = /^trees\/([^/]+)\.json$/;

/** Returns a tree's text in the editor's format, so that equal trees have equal texts. */
function normal(path: string, text: string): string {
  if (!TREE.test(path)) return text;
  try {
    return serializeDiagram(parseDiagram(text));
  } catch {
    return text;
  }
}

function mapNodes(diagram: Diagram, change: (node: DiagramNode) => DiagramNode): Diagram {
  const nodes = Object.fromEntries(Object.entries(diagram.nodes).map(([id, node]) => [id, change(node)]));
  return { ...diagram, nodes };
}

/** Renames an action's class, or a tree, and all references to it. */
function renamed(sources: Sources, path: string, name: string): Record<string, string> {
  const action = ACTION.exec(path)?.[1];
  const tree = TREE.exec(path)?.[1];
  const result: Record<string, string> = {};
  for (const [each, text] of Object.entries(sources)) {
    if (each === path && action !== undefined) {
      const declaration = new RegExp(`^(\\s*class\\s+)${action}\\b`, 'm');
      result[`actions/${name}.py`] = text.replace(declaration, `$1${name}`);
    } else if (TREE.test(each)) {
      const diagram = parseDiagram(text);
      const changed = mapNodes(diagram, (node) => {
        if (action !== undefined && node.type === action) return { ...node, type: name };
        return tree !== undefined && node.tree === tree ? { ...node, tree: name } : node;
      });
      const place = each === path ? `trees/${name}.json` : each;
      result[place] = serializeDiagram(each === path ? { ...changed, id: name } : changed);
    } else result[each] = text;
  }
  return result;
}

/**
 * Returns the files of a tree and of everything that it uses: its actions, the trees that it calls, and
 * theirs.
 */
export function closureOf(tree: string, files: Sources): Sources {
  const found: Record<string, string> = {};
  const waiting = [tree];
  for (let id = waiting.pop(); id !== undefined; id = waiting.pop()) {
    const path = `trees/${id}.json`;
    const text = files[path];
    if (text === undefined || path in found) continue;
    found[path] = text;
    for (const node of Object.values(parseDiagram(text).nodes)) {
      const action = `actions/${node.type}.py`;
      const source = files[action];
      if (node.type === 'SubTree' && node.tree !== undefined) waiting.push(node.tree);
      else if (source !== undefined) found[action] = source;
    }
  }
  return found;
}

/**
 * Plans how to add a behaviour to a project. Identical files are reused. If another file has the name
 * already, the new file gets a free name, and all references to it change.
 */
export function planInsertion(
  tree: string,
  sources: Sources,
  existing: (path: string) => string | null,
  isTaken: (name: string) => boolean,
): Insertion {
  let files: Record<string, string> = Object.fromEntries(
    Object.entries(sources).map(([path, text]) => [path, normal(path, text)]),
  );
  const origin: Record<string, string> = Object.fromEntries(Object.keys(files).map((path) => [path, path]));
  const differs = (path: string) => {
    const there = existing(path);
    return there !== null && normal(path, there) !== files[path];
  };
  // A renamed file changes the files that refer to it, which may then clash too: this repeats until none
  // does.
  for (let clash = Object.keys(files).find(differs); clash; clash = Object.keys(files).find(differs)) {
    const base = (ACTION.exec(clash) ?? TREE.exec(clash))?.[1] ?? clash;
    let count = 2;
    while (isTaken(`${base}${count}`)) count += 1;
    const name = `${base}${count}`;
    const place = ACTION.test(clash) ? `actions/${name}.py` : `trees/${name}.json`;
    files = renamed(files, clash, name);
    for (const [from, to] of Object.entries(origin)) if (to === clash) origin[from] = place;
  }
  const fresh = Object.entries(files).filter(([path]) => existing(path) === null);
  const place = origin[`trees/${tree}.json`] ?? '';
  return { tree: TREE.exec(place)?.[1] ?? tree, files: Object.fromEntries(fresh), places: origin };
}

/** Returns the files of a behaviour at their places in a project. */
export function atPlaces(sources: Sources, places: Readonly<Record<string, string>>): Sources {
  let files: Record<string, string> = Object.fromEntries(
    Object.entries(sources).map(([path, text]) => [path, normal(path, text)]),
  );
  for (const [from, to] of Object.entries(places)) {
    const name = (ACTION.exec(to) ?? TREE.exec(to))?.[1];
    if (from !== to && from in files && name !== undefined) files = renamed(files, from, name);
  }
  return files;
}
