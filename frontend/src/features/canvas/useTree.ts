import { useMemo } from 'react';
import { emptyDiagram } from '@/model/diagram';
import { expandTrees, type ExpandedTree } from '@/model/expand';
import { layoutTree, type Layout } from '@/model/layout';
import type { Diagram } from '@/model/diagram';
import type { Vocabulary } from '@/model/vocabulary';
import { useEditorStore } from '@/store/project/editor';
import { problemsOf, worstByNode, type ShownProblem } from '@/store/project/problems';
import { useProjectStore } from '@/store/project';
import { useCompact } from './view/compact';

export interface TreeOnCanvas {
  readonly diagram: Diagram;
  /** The drawn tree, including the expanded trees of its SubTrees. */
  readonly shown: ExpandedTree;
  readonly vocabulary: Vocabulary;
  readonly layout: Layout;
  /** Whether leaves are drawn below each other. */
  readonly isCompact: boolean;
  readonly problems: ReadonlyMap<string, ShownProblem>;
  readonly selection: ReadonlySet<string>;
}

const NONE: readonly string[] = [];
const CLOSED: ReadonlySet<string> = new Set();
const NO_TREES: Readonly<Record<string, Diagram>> = {};

/** Returns the data that the canvas draws of a tree, computed once for each change. */
export function useTree(treeId: string): TreeOnCanvas {
  const stored = useProjectStore((state) => state.diagrams[treeId]);
  const vocabulary = useProjectStore((state) => state.vocabulary);
  const diagnostics = useProjectStore((state) => state.diagnostics);
  const chosen = useProjectStore((state) => (state.activeTree === treeId ? state.selection : NONE));
  const diagram = useMemo(() => stored ?? emptyDiagram(treeId), [stored, treeId]);
  const expanded = useEditorStore((state) => state.expanded[treeId]) ?? CLOSED;
  const others = useProjectStore((state) => (expanded.size > 0 ? state.diagrams : NO_TREES));
  const shown = useMemo(() => expandTrees(diagram, others, expanded), [diagram, others, expanded]);
  const isCompact = useCompact((state) => state.isCompact);
  const layout = useMemo(
    () => layoutTree(shown.diagram, vocabulary, { isCompact }),
    [shown, vocabulary, isCompact],
  );
  const problems = useMemo(
    () => worstByNode(problemsOf(diagram, vocabulary, diagnostics)),
    [diagram, vocabulary, diagnostics],
  );
  const selection = useMemo(() => new Set(chosen), [chosen]);
  return { diagram, shown, vocabulary, layout, isCompact, problems, selection };
}
