import { keepPreviousData, useQuery } from '@tanstack/react-query';
import { revisions } from '@/api/revisions';
import { trees } from '@/api/trees';
import { parseDiagram, serializeDiagram } from '@/model/serialize';
import type { Diagram } from '@/model/diagram';
import { useProjectStore } from '@/store/project';

type Sides = readonly [older: number, newer: number];

/** Returns the files that differ between two revisions. */
export function useDifferences([older, newer]: Sides, enabled = true) {
  const projectId = useProjectStore((state) => state.projectId) ?? '';
  return useQuery({
    queryKey: ['differences', projectId, older, newer],
    queryFn: ({ signal }) => revisions.differences(projectId, newer, older, signal),
    enabled,
    // Revisions never change.
    staleTime: Infinity,
    placeholderData: keepPreviousData,
  });
}

export interface FileSides {
  readonly before: string | null;
  readonly after: string | null;
}

/** Returns the text of a file in two revisions; null where the file does not exist or is not text. */
export function useFileSides(path: string | null, [older, newer]: Sides) {
  const projectId = useProjectStore((state) => state.projectId) ?? '';
  const differences = useDifferences([older, newer], path !== null);
  const change = differences.data?.find((each) => each.path === path)?.change;
  return useQuery({
    queryKey: ['file-sides', projectId, path, older, newer],
    queryFn: async ({ signal }): Promise<FileSides> => {
      const text = (number: number) => revisions.text(projectId, number, path ?? '', signal);
      // A file that a revision lacks is not requested.
      const [before, after] = await Promise.all([
        change === 'added' ? null : text(older),
        change === 'removed' ? null : text(newer),
      ]);
      return { before, after };
    },
    staleTime: Infinity,
    enabled: path !== null && !differences.isPending && !differences.isPlaceholderData,
  });
}

/** Returns the diagram of a text; an empty one if the file did not exist, null if it cannot be drawn. */
export function diagramOf(text: string | null, id: string): Diagram | null {
  const none = { format: 'bt-studio/diagram', version: 1, id, root: null, nodes: {}, drafts: [] };
  try {
    return { ...parseDiagram(text ?? none), id };
  } catch {
    return null;
  }
}

/** Returns both states of a tree as XML; the text is empty where the tree did not exist. */
export function useXmlSides(before: Diagram | null, after: Diagram | null, sides: Sides) {
  const id = after?.id ?? before?.id ?? '';
  return useQuery({
    queryKey: ['xml-sides', useProjectStore.getState().projectId, id, ...sides],
    queryFn: async () => {
      const xml = async (diagram: Diagram | null) =>
        diagram === null || diagram.root === null ? '' : (await trees.write(serializeDiagram(diagram))).xml;
      const [older, newer] = await Promise.all([xml(before), xml(after)]);
      return { before: older, after: newer };
    },
    staleTime: Infinity,
  });
}
