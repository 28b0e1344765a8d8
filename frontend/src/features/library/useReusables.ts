import { keepPreviousData, useQuery } from '@tanstack/react-query';
import { api } from '@/api/client';
import type { BehaviourInfo } from '@/api/types';
import { reusablesOf, type Reusable } from '@/store/project/library';

/** A reusable behaviour with the data that the panel shows. */
export interface Offer extends Reusable {
  readonly group: string;
  readonly summary: string;
  readonly doc: string;
  readonly diagram: unknown;
}

function offerOf(behaviour: BehaviourInfo, language: string): Offer {
  const { id, version, group, diagram, files } = behaviour;
  const text = (texts: Record<string, string>) => texts[language.slice(0, 2)] ?? texts['en'] ?? '';
  return {
    id,
    version,
    group,
    diagram,
    files,
    source: 'library',
    summary: text(behaviour.summary),
    doc: text(behaviour.doc),
  };
}

/** Returns the behaviours of the built-in library. */
export function useLibrary(language: string) {
  return useQuery({
    queryKey: ['behaviours'],
    queryFn: api.behaviours,
    staleTime: Infinity,
    select: (items) => items.map((item) => offerOf(item, language)),
  });
}

/** Returns the user's other projects that match a search, the newest first. */
export function useOtherProjects(projectId: string | null, search: string) {
  return useQuery({
    queryKey: ['projects', 'to reuse', search],
    placeholderData: keepPreviousData,
    queryFn: ({ signal }) =>
      api.listProjects({ search, sort: '-updated_at', shelf: 'current', offset: 0 }, signal),
    select: ({ items }) => items.filter(({ id }) => id !== projectId),
  });
}

/** Returns the trees of another project. */
export function useTreesOf(project: string | null) {
  return useQuery({
    queryKey: ['reusables', project],
    queryFn: async ({ signal }): Promise<Offer[]> => {
      const detail = await api.getProject(project ?? '', signal);
      const texts = detail.files.flatMap(({ path, content }) => (content === null ? [] : [[path, content]]));
      const files = Object.fromEntries(texts) as Record<string, string>;
      return reusablesOf(detail.id, detail.revision, files).map((reusable) => ({
        ...reusable,
        group: 'project',
        summary: detail.description,
        doc: '',
        diagram: JSON.parse(files[`trees/${reusable.id}.json`] ?? 'null') as unknown,
      }));
    },
    enabled: project !== null,
    gcTime: 0,
  });
}
