import { nameIn, titleOf } from '@/model/document/glance';
import { useProjectStore } from '@/store/project';
import { documentName, filesOf, followDocument, kindOf, pathNamed } from '@/store/project/moving';
import { openFile, renamed } from '@/store/project/navigation';
import { useUniverseChoice } from '@/store/run/universeChoice';
import { fetchBinaries, putBinaries } from '@/store/saving/binary';

/** Renames a universe, a robot with all its files, or another file. */
export async function renameDocument(path: string, name: string): Promise<void> {
  const project = useProjectStore.getState();
  const to = pathNamed(path, name);
  const moved = (file: string) =>
    kindOf(path) === 'robot' ? file.replace(/^robots\/[^/]+/, `robots/${name}`) : to;
  const files = filesOf(path);
  const named = await withName(path, name);
  const binaries = await fetchBinaries(
    files.filter((file) => ['binary', 'large'].includes(project.files[file]?.kind ?? '')),
  );
  for (const file of files) {
    const text = project.currentText(file);
    if (text !== null) project.addFile(moved(file), file === path ? (named ?? text) : text);
  }
  followDocument(path, name);
  if (kindOf(path) === 'universe' || kindOf(path) === 'robot')
    useUniverseChoice.setState({ universe: null, robot: null });
  // The new files are saved before the old ones are deleted.
  await putBinaries(binaries.map(({ path: file, data }) => ({ path: moved(file), data })));
  for (const file of files) {
    renamed('file', file, moved(file));
    project.deleteFile(file);
  }
  openFile(to);
}

/**
 * Returns the text of a universe or a robot with a title made from its new name; null unless the title was
 * made from the old name.
 */
async function withName(path: string, name: string): Promise<string | null> {
  const text = useProjectStore.getState().currentText(path);
  if (text === null || !['universe', 'robot'].includes(kindOf(path))) return null;
  const title = nameIn(text);
  const old = documentName(path);
  if (title !== old && title !== titleOf(old)) return null;
  const { rewrite } = await import('@/model/document/rewrite');
  return rewrite(text, [{ kind: 'set', path: ['name'], value: title === old ? name : titleOf(name) }]);
}
