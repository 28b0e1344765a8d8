import { api } from '@/api/client';
import type { Diagram } from '@/model/diagram';
import { DEFAULT_DISTRO, type RosDistro } from '@/model/rosDistros';
import { saveNow } from '@/store/saving/autosave';
import { tryParse } from '../files';
import { useProjectStore } from '../index';
import { treeIdOf, type ProjectData } from '../state';

/** Returns the distribution of a project: the one that it states, or else the one that its blocks need. */
export const distributionOf = ({
  settings,
  rosDistro,
}: Pick<ProjectData, 'settings' | 'rosDistro'>): RosDistro =>
  settings?.ros_distro ?? rosDistro ?? DEFAULT_DISTRO;

/** Blocks and ports that the new distribution does not have, and blocks whose code was changed by hand. */
export interface Left {
  readonly lacks: readonly string[];
  readonly kept: readonly string[];
}

/**
 * Makes the project one for another ROS distribution, as one step: blocks and ports of Nav2 get the names and
 * the code that they have there. Returns what stays as it is; null if another project was opened meanwhile.
 *
 * @throws The server cannot be reached, or refuses.
 */
export async function changeDistribution(to: RosDistro): Promise<Left | null> {
  const { projectId } = useProjectStore.getState();
  if (projectId === null) return null;
  await saveNow();
  const { files, lacks, kept } = await api.changeDistribution(projectId, to);
  const { apply, activeTree, mainTree, projectId: now } = useProjectStore.getState();
  if (now !== projectId) return null;
  const also: Record<string, Diagram> = {};
  const texts: Record<string, string | null> = {};
  for (const { path, content } of files) {
    const id = treeIdOf(path);
    const diagram = id === null || content === null ? null : tryParse(id, content);
    if (id !== null && diagram) also[id] = diagram;
    else texts[path] = content;
  }
  apply(activeTree ?? mainTree, 'distribution', [], { also, files: texts });
  return { lacks, kept };
}
