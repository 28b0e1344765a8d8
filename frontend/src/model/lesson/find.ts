import { displayName, preorder, type Diagram, type NodeId } from '../diagram';

export interface Found {
  readonly tree: string;
  readonly node: NodeId;
}

const search = (
  trees: readonly Diagram[],
  fits: (name: string, type: string) => boolean,
): Found | undefined => {
  for (const tree of trees) {
    const node = preorder(tree).find((id) => {
      const each = tree.nodes[id];
      return each !== undefined && fits(displayName(each), each.type);
    });
    if (node !== undefined) return { tree: tree.id, node };
  }
  return undefined;
};

/** Returns the first block with a name, otherwise the first of a type; the main tree is searched first. */
export function findBlock(
  diagrams: Readonly<Record<string, Diagram>>,
  mainTree: string,
  wanted: string,
): Found | null {
  const trees = Object.values(diagrams).sort((a, b) => Number(b.id === mainTree) - Number(a.id === mainTree));
  return search(trees, (name) => name === wanted) ?? search(trees, (_name, type) => type === wanted) ?? null;
}

/**
 * Returns the path of the project's lesson in a language, otherwise in English, otherwise in any language;
 * null without a lesson.
 */
export function lessonPath(paths: readonly string[], language: string): string | null {
  const lessons = paths.filter((path) => /^lessons\/[^/]+\.md$/.test(path)).sort();
  const wanted = [`lessons/${language}.md`, 'lessons/en.md'].find((path) => lessons.includes(path));
  return wanted ?? lessons[0] ?? null;
}
