import { keepPreviousData, useInfiniteQuery, useQueryClient } from '@tanstack/react-query';
import { useEffect, useRef } from 'react';
import { fetchAgain } from '@/api/queries';
import { revisions, type Revision } from '@/api/revisions';
import { useProjectStore } from '@/store/project';

const keyOf = (projectId: string | null) => ['revisions', projectId] as const;

/** Returns the revisions of a file, or of the whole project if the path is empty; the newest come first. */
export function useRevisions(path: string, isVisible: boolean) {
  const projectId = useProjectStore((state) => state.projectId);
  const revision = useProjectStore((state) => state.revision);
  const client = useQueryClient();
  const found = useInfiniteQuery({
    queryKey: [...keyOf(projectId), path],
    queryFn: ({ pageParam, signal }) => revisions.list(projectId ?? '', path, pageParam, signal),
    initialPageParam: null as number | null,
    getNextPageParam: (page) => page.next_before,
    placeholderData: keepPreviousData,
    enabled: isVisible && projectId !== null,
  });
  const seen = useRef(revision);
  useEffect(() => {
    if (seen.current === revision) return;
    seen.current = revision; // it was saved, here or elsewhere
    void fetchAgain(client, keyOf(projectId));
  }, [client, projectId, revision]);
  const items: Revision[] = found.data?.pages.flatMap((page) => page.items) ?? [];
  return { ...found, items };
}

/** Returns a function that sets or removes the name of a revision. */
export function useLabel(): (number: number, label: string) => Promise<void> {
  const client = useQueryClient();
  const projectId = useProjectStore((state) => state.projectId);
  return async (number, label) => {
    if (projectId === null) return;
    await revisions.label(projectId, number, label);
    await fetchAgain(client, keyOf(projectId));
  };
}
