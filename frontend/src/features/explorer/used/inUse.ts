import { useQuery } from '@tanstack/react-query';
import { useShallow } from 'zustand/react/shallow';
import { api } from '@/api/client';
import { queries } from '@/api/queries';
import { robotIn } from '@/model/document/glance';
import { useProjectStore } from '@/store/project';
import { OUTSIDE } from '@/features/universe/titles';

export type Kind = 'universe' | 'robot';

/** The universe or the robot with which the project runs. */
export interface InUse {
  readonly kind: Kind;
  readonly id: string;
  /** The file of one that the project has itself; null: a built-in one. */
  readonly path: string | null;
  /** The universe places this robot; the project names none. */
  readonly isOfUniverse: boolean;
}

const FILES: Readonly<Record<Kind, (id: string) => string>> = {
  universe: (id) => `universes/${id}.yaml`,
  robot: (id) => `robots/${id}/robot.yaml`,
};

type Project = ReturnType<typeof useProjectStore.getState>;

function inUse(project: Project, kind: Kind, id: string, isOfUniverse = false): InUse {
  const path = FILES[kind](id);
  return { kind, id, path: path in project.files ? path : null, isOfUniverse };
}

const universeOf = (project: Project): InUse | null => {
  const id = project.settings?.universe ?? '';
  return id === '' ? null : inUse(project, 'universe', id);
};

/** Whether the program joins an outside ROS graph, without a simulated world. */
export const isOutside = ({ kind, id, path }: InUse): boolean =>
  kind === 'universe' && id === OUTSIDE && path === null;

const textQuery = (universe: string) => ({
  queryKey: ['universe text', universe],
  queryFn: () => api.universeText(universe),
  staleTime: Infinity,
});

/** The built-in universe whose text names the robot; null where it is known without. */
function universeToAsk(project: Project): string | null {
  const universe = universeOf(project);
  if (!universe || universe.path || isOutside(universe) || project.settings?.robot) return null;
  return universe.id;
}

/** The robot of the project, or of its universe; `text` is that of a built-in universe. */
function robotOf(project: Project, text: string | undefined): InUse | null {
  const universe = universeOf(project);
  if (!universe || isOutside(universe)) return null;
  const named = project.settings?.robot;
  if (named) return inUse(project, 'robot', named);
  const placed = robotIn((universe.path ? project.currentText(universe.path) : text) ?? '');
  return placed === null ? null : inUse(project, 'robot', placed, true);
}

/** What the project runs with; the robot of a built-in universe is asked of the server. */
export async function findInUse(kind: Kind): Promise<InUse | null> {
  const project = useProjectStore.getState();
  if (kind === 'universe') return universeOf(project);
  const asked = universeToAsk(project);
  return robotOf(project, asked === null ? undefined : await queries.fetchQuery(textQuery(asked)));
}

/** What the project runs with, as the universe first and then the robot; only what is known yet. */
export function useInUse(): readonly InUse[] {
  useProjectStore(useShallow(({ settings, files }) => [settings, files]));
  const project = useProjectStore.getState();
  const asked = universeToAsk(project);
  const { data } = useQuery({ ...textQuery(asked ?? ''), enabled: asked !== null });
  return [universeOf(project), robotOf(project, asked === null ? undefined : data)].filter(
    (each) => each !== null,
  );
}
