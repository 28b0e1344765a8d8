import { parseDiagram, serializeDiagram } from './serialize';
import type { Diagram, DiagramNode } from './diagram';

/** Files by their paths in a project. */
export type Sources = Readonly<Record<string, string>>;

/** The result of adding a behaviour to a project. */
export interface Insertion {
  /** The tree to use, under the name that it has in the project. */
  readonly tree: string;
  /** What is to be written, by path; what is there already with the same content is left out. */
  readonly files: Sources;
  /** Where each file of the behaviour is in the project. */
  readonly places: Readonly<Record<string, string>>;
}

const ACTION = /^actions\/([^/]+)\.py$/;
const TREE = /^trees\/([^/]+)\.json$/;

/** A tree's text as this editor writes it, so that the same trees are the same texts. */
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

/** Gives an action's class, or a tree, and what refers to it, another name. */
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
 * The files of one tree and of all that it uses, out of a project's: the trees below it and their actions.
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
 * Plans how a behaviour comes into a project. What is there already, word for word, is used; where
 * something else has the name, the newcomer gets a free one, and all that refers to it follows.
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
  // A renamed file changes those that refer to it, which may then differ as well: again until none does.
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

/** The files of a behaviour as they would be at their places in a project. */
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
