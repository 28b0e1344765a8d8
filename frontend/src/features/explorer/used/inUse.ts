import { useQuery } from '@tanstack/react-query';
import { useShallow } from 'zustand/react/shallow';
import { api } from '@/api/client';
import { queries } from '@/api/queries';
import { robotIn } from '@/model/document/glance';
import { useFileText, withTexts } from '@/store/saving/large';
import { useProjectStore } from '@/store/project';
import { OUTSIDE } from '@/features/universe/titles';

export type Kind = 'universe' | 'robot';

/** The universe or the robot that the project uses. */
export interface InUse {
  readonly kind: Kind;
  readonly id: string;
  /** The path of its file in the project; null if it is built in. */
  readonly path: string | null;
  /** Whether the universe determines the robot, since the project does not name one. */
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

/** Returns whether the program joins an outside ROS graph, without a simulated world. */
export const isOutside = ({ kind, id, path }: InUse): boolean =>
  kind === 'universe' && id === OUTSIDE && path === null;

const textQuery = (universe: string) => ({
  queryKey: ['universe text', universe],
  queryFn: () => api.universeText(universe),
  staleTime: Infinity,
});

/** Returns the built-in universe whose text is needed to find the robot; null if none is needed. */
function universeToAsk(project: Project): string | null {
  const universe = universeOf(project);
  if (!universe || universe.path || isOutside(universe) || project.settings?.robot) return null;
  return universe.id;
}

/** Returns the robot of the project, or of its universe; `text` is the text of a built-in universe. */
function robotOf(project: Project, text: string | undefined): InUse | null {
  const universe = universeOf(project);
  if (!universe || isOutside(universe)) return null;
  const named = project.settings?.robot;
  if (named) return inUse(project, 'robot', named);
  const placed = robotIn((universe.path ? project.currentText(universe.path) : text) ?? '');
  return placed === null ? null : inUse(project, 'robot', placed, true);
}

/**
 * Returns the universe or robot that the project uses; the server is asked for the robot of a built-in
 * universe.
 */
export async function findInUse(kind: Kind): Promise<InUse | null> {
  const found = universeOf(useProjectStore.getState());
  if (kind === 'universe') return found;
  if (found?.path) await withTexts([found.path]);
  const project = useProjectStore.getState();
  const asked = universeToAsk(project);
  return robotOf(project, asked === null ? undefined : await queries.fetchQuery(textQuery(asked)));
}

/** Returns the universe and then the robot that the project uses, as far as they are known yet. */
export function useInUse(): readonly InUse[] {
  useProjectStore(useShallow(({ settings, files }) => [settings, files]));
  const project = useProjectStore.getState();
  useFileText(universeOf(project)?.path ?? null);
  const asked = universeToAsk(project);
  const { data } = useQuery({ ...textQuery(asked ?? ''), enabled: asked !== null });
  return [universeOf(project), robotOf(project, asked === null ? undefined : data)].filter(
    (each) => each !== null,
  );
}
