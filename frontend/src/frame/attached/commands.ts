import { IconDeviceFloppy, IconPlugConnectedX, IconRefresh, IconSteeringWheel } from '@tabler/icons-react';
import { api } from '@/api/client';
import { runs } from '@/api/runs';
import { registerCommands, type UserCommand } from '@/commands/registry';
import { everywhere } from '@/commands/global';
import { t } from '@/i18n';
import { announceImport } from '@/store/dialogs/importReport';
import { isViewer, reported } from '@/store/run/commands';
import { useRunStore } from '@/store/run/store';
import { runsOf } from '@/store/recording/liveSource';
import { navigate, projectPath } from '@/store/route';
import { endSession, send } from '@/store/session/connection';
import { useSessionStore } from '@/store/session/store';

/** Says whether the user controls the robot, so that breakpoints and forced results act there. */
export const setControl = (on: boolean) => reported(send('control', { on }));

/** Returns whether the program can be followed again: nothing follows it now. */
export const canAttachAgain = (): boolean =>
  useSessionStore.getState().executor === 'visualization_ready' && !isViewer();

/** Follows the program again after it could not be followed. */
export async function attachAgain(): Promise<void> {
  useRunStore.setState({ failure: null });
  useSessionStore.setState({ faults: [] });
  await reported(send('restart_application', {}));
}

/** Makes a project of the tree, as an import of its XML does; the recording becomes a run of it. */
export async function saveAsProject(): Promise<void> {
  const { attachedTree, attached, sessionId, segments } = useSessionStore.getState();
  if (attachedTree === null) return;
  const name = `${attachedTree.main_tree.replace(/[^\w-]+/g, '_')}.xml`;
  const file = new File([attachedTree.xml], name, { type: 'text/xml' });
  await reported(
    api.importProject({ file, repair: false }).then(async (project) => {
      announceImport(project.id, file.name, project.proposal);
      const run = runsOf(segments).at(-1);
      if (sessionId !== null && run !== undefined) {
        const name = t('attached:recordingOf', { address: attached?.address ?? '' });
        await reported(runs.keep(project.id, { run, name, note: '', session: sessionId }));
      }
      navigate(projectPath(project.id));
    }),
  );
}

/** Ends the session; the program runs on. */
export async function detach(): Promise<void> {
  await endSession().catch(() => undefined);
  navigate('/');
}

const rows: readonly UserCommand[] = [
  {
    id: 'attached.control',
    group: 'run',
    labelKey: 'attached:control',
    icon: IconSteeringWheel,
    enabled: () => !isViewer() && useSessionStore.getState().attached !== null,
    run: () => void setControl(!useSessionStore.getState().attached?.controls),
  },
  {
    id: 'attached.again',
    group: 'run',
    labelKey: 'attached:again',
    icon: IconRefresh,
    enabled: canAttachAgain,
    run: () => void attachAgain(),
  },
  {
    id: 'attached.save',
    group: 'project',
    labelKey: 'attached:save',
    icon: IconDeviceFloppy,
    enabled: () => useSessionStore.getState().attachedTree !== null,
    run: () => void saveAsProject(),
  },
  {
    id: 'attached.detach',
    group: 'run',
    labelKey: 'attached:detach',
    icon: IconPlugConnectedX,
    run: () => void detach(),
  },
];

export const registerAttachedCommands = () => registerCommands([...everywhere, ...rows]);

/** The name of the program's tree for the title of the page. */
export const attachedTitle = (address: string): string => t('attached:title', { address });
