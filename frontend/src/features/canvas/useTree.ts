import { useMemo } from 'react';
import { emptyDiagram } from '@/model/diagram';
import { layoutTree, type Layout } from '@/model/layout';
import type { Diagram } from '@/model/diagram';
import type { Vocabulary } from '@/model/vocabulary';
import { problemsOf, worstByNode, type ShownProblem } from '@/store/project/problems';
import { useProjectStore } from '@/store/project';

export interface TreeOnCanvas {
  readonly diagram: Diagram;
  readonly vocabulary: Vocabulary;
  readonly layout: Layout;
  readonly problems: ReadonlyMap<string, ShownProblem>;
  readonly selection: ReadonlySet<string>;
}

const NONE: readonly string[] = [];

/** Everything about a tree that the canvas draws, computed once for each change. */
export function useTree(treeId: string): TreeOnCanvas {
  const stored = useProjectStore((state) => state.diagrams[treeId]);
  const vocabulary = useProjectStore((state) => state.vocabulary);
  const diagnostics = useProjectStore((state) => state.diagnostics);
  const chosen = useProjectStore((state) => (state.activeTree === treeId ? state.selection : NONE));
  const diagram = useMemo(() => stored ?? emptyDiagram(treeId), [stored, treeId]);
  const layout = useMemo(() => layoutTree(diagram, vocabulary), [diagram, vocabulary]);
  const problems = useMemo(
    () => worstByNode(problemsOf(diagram, vocabulary, diagnostics)),
    [diagram, vocabulary, diagnostics],
  );
  const selection = useMemo(() => new Set(chosen), [chosen]);
  return { diagram, vocabulary, layout, problems, selection };
}
