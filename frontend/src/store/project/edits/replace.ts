import { canReplace, passagesOf, setText, textAt, type Passage } from '@/model/search/passages';
import { replaced, type Hit } from '@/model/search/seek';
import { useProjectStore } from '../index';
import { treeIdOf, type ProjectData } from '../state';

/** Returns all texts of the project that can be searched, trees first. */
export function allPassages({ files, diagrams }: Pick<ProjectData, 'files' | 'diagrams'>): Passage[] {
  const paths = Object.keys(files).sort();
  const trees = paths.flatMap((path) => {
    const diagram = files[path]?.kind === 'tree' ? diagrams[treeIdOf(path) ?? ''] : undefined;
    return diagram ? passagesOf(path, diagram) : [];
  });
  const texts = paths.flatMap((path) => {
    const text = files[path]?.text;
    return typeof text === 'string' ? [{ path, place: null, text }] : [];
  });
  return [...trees, ...texts];
}

/** A text, with the hits in it that are to be replaced. */
export interface Replacement {
  readonly passage: Passage;
  readonly hits: readonly Hit[];
}

export interface Replaced {
  readonly count: number;
  readonly documents: number;
  /** Reverts the replacement in each document that has not changed since then. */
  readonly undo: () => void;
}

const store = () => useProjectStore.getState();

function currentText({ path, place }: Passage): string | undefined {
  if (!place) return store().files[path]?.text ?? undefined;
  const diagram = store().diagrams[treeIdOf(path) ?? ''];
  return diagram && textAt(diagram, place);
}

/** Changes a tree in one step of its own undo stack; returns a function that reverts it. */
function replaceInTree(tree: string, list: readonly Replacement[]): () => void {
  const recipes = list.flatMap(({ passage, hits }) =>
    passage.place ? [setText(passage.place, replaced(passage.text, hits))] : [],
  );
  store().apply(tree, 'replace', recipes);
  store().seal(tree);
  const after = store().diagrams[tree];
  return () => {
    if (store().diagrams[tree] === after) store().undo(tree);
  };
}

function replaceInText(path: string, { passage, hits }: Replacement): () => void {
  const after = replaced(passage.text, hits);
  store().setFileText(path, after);
  return () => {
    if (store().currentText(path) === after) store().setFileText(path, passage.text);
  };
}

/**
 * Replaces hits in trees and texts. A text that has changed since the search is not replaced; in a read-only
 * project nothing is.
 */
export function replaceHits(list: readonly Replacement[]): Replaced {
  const valid = store().role === 'viewer' ? [] : list.filter(isValid);
  const byPath = new Map<string, Replacement[]>();
  for (const each of valid) {
    byPath.set(each.passage.path, [...(byPath.get(each.passage.path) ?? []), each]);
  }
  const undos = [...byPath].flatMap(([path, own]) => {
    const tree = treeIdOf(path);
    const [first] = own;
    if (tree !== null && first?.passage.place) return [replaceInTree(tree, own)];
    return own.map((each) => replaceInText(path, each));
  });
  return {
    count: valid.reduce((sum, { hits }) => sum + hits.length, 0),
    documents: byPath.size,
    undo: () => {
      for (const undo of undos) undo();
    },
  };
}

const isValid = ({ passage, hits }: Replacement): boolean =>
  hits.length > 0 && canReplace(passage) && currentText(passage) === passage.text;
