import { keepPreviousData, useQuery } from '@tanstack/react-query';
import { api } from '@/api/client';
import { shippedDoc } from '@/i18n/shipped';
import { useMe } from '@/features/accounts/useMe';
import type { BehaviourInfo } from '@/api/types';
import { parseDiagram } from '@/model/serialize';
import { descriptionOf, isOffered } from '@/model/treeAttributes';
import type { Sources } from '@/model/reuse';
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
  /** The owner of its project, if that is another user. */
  readonly owner: string | null;
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
    owner: null,
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

/** The data of a project that its reusable trees need. */
interface Origin {
  readonly project: string;
  readonly name: string;
  readonly description: string;
  readonly owner: string | null;
  readonly revision: number;
  readonly main_tree: string;
  readonly files: Sources;
}

/** Returns the trees of a project with the data that the panel shows. */
function treesOf(origin: Origin): readonly Offer[] {
  const { project, name, description, owner, revision, main_tree, files } = origin;
  return reusablesOf(project, revision, files).map((reusable) => {
    const diagram = parseDiagram(files[treePath(reusable.id)] ?? '');
    const isMain = reusable.id === main_tree;
    return {
      ...reusable,
      group: 'project',
      summary: shippedDoc(reusable.id, descriptionOf(diagram)) || (isMain ? description : ''),
      doc: '',
      diagram,
      project: name,
      owner,
      isOffered: isOffered(diagram),
    };
  });
}

/** Returns the trees that the user's other projects, and those shared with the user, offer. */
export function useOffers(projectId: string | null) {
  const me = useMe();
  return useQuery({
    queryKey: ['reusables', 'offered'],
    queryFn: ({ signal }) => api.offers(signal),
    // A visitor with a link has no projects; the server would refuse.
    enabled: me !== undefined && me.role !== 'guest',
    select: (items) =>
      items
        .filter(({ project }) => project !== projectId)
        .flatMap((item) => {
          const owner = item.owner === me?.user ? null : item.owner;
          return treesOf({ ...item, owner }).filter((offer) => offer.isOffered);
        }),
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
      const files: Record<string, string> = {};
      for (const { path, content, left_out: isLeftOut } of detail.files) {
        const isNeeded = isLeftOut && path.startsWith('actions/');
        const text = isNeeded ? await api.fileText(detail.id, path, signal) : content;
        if (text !== null) files[path] = text;
      }
      return [...treesOf({ ...detail, project: detail.id, owner: null, files })];
    },
    enabled: project !== null,
    gcTime: 0,
  });
}
