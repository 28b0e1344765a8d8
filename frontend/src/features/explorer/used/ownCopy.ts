import { notifications } from '@mantine/notifications';
import { create } from 'zustand';
import { reasonOf } from '@/api/reason';
import { t } from '@/i18n';
import { useProjectStore } from '@/store/project';
import { openFile } from '@/store/project/navigation';
import { useUniverseChoice } from '@/store/run/universeChoice';
import { undoNotification } from '@/ui/undoNotification';
import { closeTab } from '@/workspace/tabs';
import { freeName, takenRobots, takenUniverses } from '@/features/universe/freeNames';
import { findInUse, isOutside, type InUse, type Kind } from './inUse';

/** The kind of document that is being copied; null if none is. */
export const useCopying = create<{ kind: Kind | null }>(() => ({ kind: null }));

/** Returns whether a used document can be copied: it is built in, and the user may change the project. */
export const canCopy = (used: InUse): boolean =>
  used.path === null && !isOutside(used) && useProjectStore.getState().role !== 'viewer';

/** Adds a copy to the project; returns the paths of its files, with the document first. */
async function copied({ kind, id }: InUse): Promise<readonly string[]> {
  const { copyRobot, copyUniverse } = await import('@/features/universe/copying');
  const before = useProjectStore.getState().files;
  const isUniverse = kind === 'universe';
  const taken = (isUniverse ? takenUniverses : takenRobots)(Object.keys(before));
  const path = await (isUniverse ? copyUniverse : copyRobot)(id, freeName(`my_${id}`, taken));
  const others = Object.keys(useProjectStore.getState().files).filter((each) => !(each in before));
  return [path, ...others.filter((each) => each !== path)];
}

/** Makes the project use a copy; returns a function that restores the previous setting. */
function runWith(kind: Kind, name: string): () => void {
  const { settings, setSettings } = useProjectStore.getState();
  const { universe, robot } = settings ?? {};
  // A temporary choice would take precedence over the copy.
  useUniverseChoice.setState({ [kind]: null });
  setSettings({ [kind]: name });
  return () =>
    useProjectStore.getState().setSettings(kind === 'universe' ? { universe: universe ?? '' } : { robot });
}

/**
 * Copies the built-in universe or robot that the project uses into the project, makes the project use the
 * copy, and opens its editor. A notification offers to undo all of this.
 */
export async function makeOwnCopy(kind: Kind): Promise<void> {
  if (useCopying.getState().kind) return;
  useCopying.setState({ kind });
  const progress = notifications.show({
    loading: true,
    autoClose: false,
    withCloseButton: false,
    message: t(`frame:explorer.used.copying.${kind}`),
  });
  try {
    const used = await findInUse(kind);
    if (!used || !canCopy(used)) return;
    const paths = await copied(used);
    const [path = ''] = paths;
    const name = path.replace(/^(universes|robots)\/([^/]+?)(\.yaml|\/robot\.yaml)$/, '$2');
    const revert = runWith(kind, name);
    openFile(path);
    undoNotification({
      message: t('frame:explorer.used.copied', { name }),
      undoLabel: t('frame:undo'),
      undo: () => {
        revert();
        for (const each of paths) {
          closeTab({ kind: 'file', path: each });
          useProjectStore.getState().deleteFile(each);
        }
      },
    });
  } catch (error) {
    const reason = reasonOf(error);
    notifications.show({ color: 'red', message: t('frame:explorer.used.notCopied', { reason }) });
  } finally {
    notifications.hide(progress);
    useCopying.setState({ kind: null });
  }
}
