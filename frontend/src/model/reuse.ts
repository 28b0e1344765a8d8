import { parseDiagram, serializeDiagram } from './serialize';
import type { Diagram, DiagramNode } from './diagram';
import { importsName, withName } from './pythonNames';

/** The contents of files, by path. */
export type Sources = Readonly<Record<string, string>>;

/** The choice for an incoming file if another file of the project has its name. */
export type Choice = 'keep' | 'rename' | 'replace';

/** An incoming file, and what happens to it. */
export interface Arrival {
  /** Its path in the project or behaviour that it comes from. */
  readonly path: string;
  /** Its path in the project. */
  readonly place: string;
  /**
   * `new`: no file has its name. `same`: the project has an identical file. Otherwise another file has its
   * name, and this is the choice.
   */
  readonly state: 'new' | 'same' | Choice;
}

/** The result of bringing files to a project. */
export interface Insertion {
  /**
   * The incoming files, in order of use. A file is left out if it is needed only by files that are not added.
   */
  readonly arrivals: readonly Arrival[];
  /** The files to write, by path, without those that already have the same content. */
  readonly files: Sources;
  /** The path in the project of each incoming file. */
  readonly places: Readonly<Record<string, string>>;
}

/** The files that are brought to a project, and the files that the project has. */
export interface Bringing {
  /** The paths that are used where the user inserts: a tree, or the actions and trees of blocks. */
  readonly needs: readonly string[];
  readonly sources: Sources;
  readonly existing: (path: string) => string | null;
  readonly isTaken: (name: string) => boolean;
  /** The choices by path; without a choice, a file whose name is taken is renamed. */
  readonly choices?: Readonly<Record<string, Choice>>;
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
    if (each === path && action !== undefined) result[`actions/${name}.py`] = withName(text, action, name);
    else if (action !== undefined && ACTION.test(each) && importsName(text, action)) {
      result[each] = withName(text, action, name);
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

/** Returns the name in a path of an action or a tree. */
export const nameIn = (path: string): string => (ACTION.exec(path) ?? TREE.exec(path))?.[1] ?? path;

const normalized = (sources: Sources): Record<string, string> =>
  Object.fromEntries(Object.entries(sources).map(([path, text]) => [path, normal(path, text)]));

/** Returns the path of the file that a block uses: the tree of a SubTree, or the action of its type. */
export const pathOf = ({ type, tree }: Pick<DiagramNode, 'type' | 'tree'>): string =>
  type === 'SubTree' ? `trees/${tree ?? ''}.json` : `actions/${type}.py`;

/** Returns the files that a file refers to: actions and trees of a tree, the other actions that an action imports. */
function referencesOf(path: string, files: Sources): string[] {
  const text = files[path] ?? '';
  const paths = ACTION.test(path)
    ? Object.keys(files).filter((each) => ACTION.test(each) && importsName(text, nameIn(each)))
    : Object.values(parseDiagram(text).nodes).map(pathOf);
  return paths.filter((each) => each in files);
}

/** Returns the given paths and all that their files refer to, in order of use. */
function reached(needs: readonly string[], files: Sources, isOpened: (path: string) => boolean): Set<string> {
  const found = new Set(needs.filter((path) => path in files));
  for (const path of found) {
    if (!isOpened(path)) continue;
    for (const next of referencesOf(path, files)) found.add(next);
  }
  return found;
}

/** Returns the files at the given paths and everything that they use: their actions, and the trees that they call. */
export function closureOf(needs: readonly string[], files: Sources): Sources {
  const found = [...reached(needs, files, () => true)];
  return Object.fromEntries(found.map((path) => [path, files[path] ?? '']));
}

/**
 * Plans how to bring files to a project. Identical files are reused; a file whose name is taken by something
 * else is left out, replaces it, or gets a free name, and all references to it change.
 */
export function planInsertion({ needs, sources, existing, isTaken, choices = {} }: Bringing): Insertion {
  let files = normalized(sources);
  const places = new Map(Object.keys(files).map((path) => [path, path]));
  const differs = (place: string) => {
    const there = existing(place);
    return there !== null && normal(place, there) !== files[place];
  };
  const clashing = () =>
    [...places].find(([path, place]) => differs(place) && (choices[path] ?? 'rename') === 'rename');
  // A renamed file changes the files that refer to it, which may then clash too: repeated until none does.
  for (let clash = clashing(); clash; clash = clashing()) {
    const [path, place] = clash;
    const placed = (name: string) => place.replace(nameIn(place), name);
    let count = 2;
    while (isTaken(`${nameIn(path)}${count}`) || placed(`${nameIn(path)}${count}`) in files) count += 1;
    const name = `${nameIn(path)}${count}`;
    files = renamed(files, place, name);
    places.set(path, placed(name));
  }
  const origins = new Map([...places].map(([path, place]) => [place, path]));
  const stateOf = (path: string, place: string): Arrival['state'] => {
    if (path !== place) return 'rename';
    if (existing(place) === null) return 'new';
    return differs(place) ? (choices[path] ?? 'rename') : 'same';
  };
  const isKept = (place: string) => stateOf(origins.get(place) ?? place, place) === 'keep';
  const starts = needs.map((path) => places.get(path) ?? path);
  const used = reached(starts, files, () => true);
  const loose = Object.keys(files).filter((place) => !used.has(place));
  const taken = [...reached(starts, files, (place) => !isKept(place)), ...loose];
  const arrivals = taken.map((place) => {
    const path = origins.get(place) ?? place;
    return { path, place, state: stateOf(path, place) };
  });
  const written = arrivals.filter(({ state }) => state !== 'same' && state !== 'keep');
  return {
    arrivals,
    files: Object.fromEntries(written.map(({ place }) => [place, files[place] ?? ''])),
    places: Object.fromEntries(arrivals.map(({ path, place }) => [path, place])),
  };
}

/** Returns the files of a behaviour at their places in a project. */
export function atPlaces(sources: Sources, places: Readonly<Record<string, string>>): Sources {
  let files = normalized(sources);
  for (const [from, to] of Object.entries(places)) {
    if (from !== to && from in files) files = renamed(files, from, nameIn(to));
  }
  return files;
}
