import { notifications } from '@mantine/notifications';
import { undoNotification } from '@/ui/undoNotification';
import { reasonOf } from '@/api/reason';
import { t } from '@/i18n';
import { useProjectStore } from '@/store/project';
import { documentName, filesOf, followDocument } from '@/store/project/moving';
import { treeIdOf } from '@/store/project/state';
import { useUniverseChoice } from '@/store/run/universeChoice';
import { fetchBinaries, putBinaries } from '@/store/saving/binary';
import { closeTab } from '@/workspace/tabs';

/** Deletes a document (all files of a robot); a notification offers to undo this. */
export async function removeDocument(path: string): Promise<void> {
  const project = useProjectStore.getState();
  const files = filesOf(path);
  const name = documentName(path);
  try {
    // Undo needs the content of binary files, which the page does not have, so they are fetched before the
    // deletion.
    const binaries = await fetchBinaries(
      files.filter((file) => ['binary', 'large'].includes(project.files[file]?.kind ?? '')),
    );
    const texts = files.flatMap((file) => {
      const text = project.currentText(file);
      return text === null ? [] : [{ file, text }];
    });
    const treeId = treeIdOf(path);
    if (treeId !== null) closeTab({ kind: 'tree', id: treeId });
    for (const file of files) {
      closeTab({ kind: 'file', path: file });
      project.deleteFile(file);
    }
    const refollow = followDocument(path);
    const { universe, robot } = useUniverseChoice.getState();
    if (universe === name || robot === name) useUniverseChoice.setState({ universe: null, robot: null });
    const others = files.length - 1;
    undoNotification({
      message: [
        others > 0
          ? t('frame:explorer.deletedWith', { name, count: others })
          : t('frame:explorer.deleted', { name }),
        ...(refollow ? [t('frame:explorer.noLongerUsed')] : []),
      ].join(' '),
      undoLabel: t('frame:undo'),
      undo: () => {
        for (const { file, text } of texts) useProjectStore.getState().addFile(file, text);
        refollow?.();
        putBinaries(binaries).catch(tell);
      },
    });
  } catch (error) {
    tell(error);
  }
}

function tell(error: unknown): void {
  notifications.show({ color: 'red', message: reasonOf(error) });
}
