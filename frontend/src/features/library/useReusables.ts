import { keepPreviousData, useQuery } from '@tanstack/react-query';
import { api } from '@/api/client';
import type { BehaviourInfo } from '@/api/types';
import { parseDiagram } from '@/model/serialize';
import { descriptionOf, isOffered } from '@/model/treeAttributes';
import { reusablesOf, type Reusable } from '@/store/project/library';
import { treePath } from '@/store/project/state';

/** A reusable behaviour with the data that the panel shows. */
export interface Offer extends Reusable {
  readonly group: string;
  readonly summary: string;
  readonly doc: string;
  readonly diagram: unknown;
  /** The name of its project; null in the built-in library. */
  readonly project: string | null;
  /** Whether its project explicitly offers it. */
  readonly isOffered: boolean;
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
    project: null,
    isOffered: true,
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
      return reusablesOf(detail.id, detail.revision, files).map((reusable) => {
        const diagram = parseDiagram(files[treePath(reusable.id)] ?? '');
        const isMain = reusable.id === detail.main_tree;
        return {
          ...reusable,
          group: 'project',
          summary: descriptionOf(diagram) || (isMain ? detail.description : ''),
          doc: '',
          diagram,
          project: detail.name,
          isOffered: isOffered(diagram),
        };
      });
    },
    enabled: project !== null,
    gcTime: 0,
  });
}
