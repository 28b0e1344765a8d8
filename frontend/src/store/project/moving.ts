import { useProjectStore } from '.';

const UNIVERSE = /^universes\/([^/]+)\.yaml$/;
const ROBOT = /^robots\/([^/]+)\/robot\.yaml$/;

/** The kind of document of a file in the explorer. */
export type DocumentKind = 'tree' | 'action' | 'universe' | 'robot' | 'file';

export function kindOf(path: string): DocumentKind {
  if (/^trees\/[^/]+\.json$/.test(path)) return 'tree';
  if (/^actions\/[^/]+\.py$/.test(path)) return 'action';
  if (UNIVERSE.test(path)) return 'universe';
  return ROBOT.test(path) ? 'robot' : 'file';
}

/** Returns the name of a document; for a robot, that of its folder. */
export const documentName = (path: string): string =>
  (UNIVERSE.exec(path) ?? ROBOT.exec(path))?.[1] ??
  path.replace(/^actions\/(.+)\.py$/, '$1').replace(/^trees\/(.+)\.json$/, '$1');

/** Returns the files of a document; for a robot, all files in its folder. */
export function filesOf(path: string): string[] {
  const { files } = useProjectStore.getState();
  const folder = kindOf(path) === 'robot' ? path.slice(0, path.lastIndexOf('/') + 1) : null;
  return folder === null ? [path] : Object.keys(files).filter((each) => each.startsWith(folder));
}

/** Returns the path of a document after renaming. */
export function pathNamed(path: string, name: string): string {
  const kind = kindOf(path);
  if (kind === 'universe') return `universes/${name}.yaml`;
  return kind === 'robot' ? `robots/${name}/robot.yaml` : name;
}

/** The universe of a project whose settings do not name one. */
const FIRST_UNIVERSE = 'empty';

/**
 * Updates the project's settings after a universe or a robot was removed or renamed. If the universe was
 * removed, the project runs in the empty one; if the robot was removed, it runs with the universe's own
 * robot.
 *
 * @returns a function that reverts the change, or null if the project does not use the document
 */
export function followDocument(path: string, name?: string): (() => void) | null {
  const kind = kindOf(path);
  const { settings, setSettings } = useProjectStore.getState();
  const now = documentName(path);
  if (kind === 'universe' && settings?.universe === now) {
    setSettings({ universe: name ?? FIRST_UNIVERSE });
    return () => setSettings({ universe: now });
  }
  if (kind === 'robot' && settings?.robot === now) {
    setSettings({ robot: name });
    return () => setSettings({ robot: now });
  }
  return null;
}
