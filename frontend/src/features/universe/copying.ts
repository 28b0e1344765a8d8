import { api } from '@/api/client';
import { rewrite } from '@/model/document/rewrite';
import { titleOf } from '@/model/document/glance';
import { useProjectStore } from '@/store/project';
import { textsOfRobot } from './textsOfRobot';

/** Adds a copy of a built-in universe to the project, with the title of its file; resolves to its path. */
export async function copyUniverse(base: string, name: string): Promise<string> {
  const text = await api.universeText(base);
  const path = `universes/${name}.yaml`;
  useProjectStore
    .getState()
    .addFile(path, rewrite(text, [{ kind: 'set', path: ['name'], value: titleOf(name) }]));
  return path;
}

/** Adds a copy of the template or of a built-in robot to the project; resolves to the path of its `robot.yaml`. */
export async function copyRobot(base: string, name: string): Promise<string> {
  const { yaml, urdf, urdfName } = await textsOfRobot(base, name);
  const project = useProjectStore.getState();
  const path = `robots/${name}/robot.yaml`;
  project.addFile(`robots/${name}/${urdfName}`, urdf);
  project.addFile(path, yaml);
  return path;
}
