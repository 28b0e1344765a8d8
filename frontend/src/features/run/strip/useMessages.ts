import { useShallow } from 'zustand/react/shallow';
import { useProjectStore } from '@/store/project';
import { errorsOf } from '@/store/project/problems';
import { useRunStore } from '@/store/run/store';
import { doesWorldRunAlone } from '@/store/session/clock';
import { useSessionStore } from '@/store/session/store';
import { useHasChanged } from '../useHasChanged';
import { viewerKey } from './dismiss';
import { messagesFor, type StripMessage } from './messages';

/** Returns all messages of the run, the most important first. */
export function useMessages(): StripMessage[] {
  const session = useSessionStore(
    useShallow((state) => ({
      connection: state.connection,
      connectionMessage: state.connectionMessage,
      silentS: state.silentS,
      executorReason: state.executorReason,
      faults: state.faults,
      finished: state.finished,
      launchNodes: state.launchNodes,
    })),
  );
  const failure = useRunStore((state) => state.failure);
  const isViewer = useIsUnreadViewer();
  const wasTakenOver = useSessionStore((state) => state.wasTakenOver);
  const canRestart = useCanRestart();
  const worldRuns = useSessionStore(doesWorldRunAlone);
  const viewer = isViewer ? { wasTakenOver } : null;
  return messagesFor({ ...session, failure, viewer, canRestart, worldRuns });
}

function useIsUnreadViewer(): boolean {
  const key = useSessionStore(({ connection, introspection }) =>
    connection === 'open' && introspection?.role === 'viewer' ? viewerKey() : null,
  );
  const read = useRunStore((state) => state.readTakeOver);
  return key !== null && key !== read;
}

/** Returns whether to offer a restart: the program has been edited while it runs. */
function useCanRestart(): boolean {
  const hasApplication = useSessionStore(
    ({ executor, introspection }) =>
      (executor === 'application_running' || executor === 'paused') && introspection?.role !== 'viewer',
  );
  const hasChanged = useHasChanged();
  const isStill = useRunStore(({ stage, ranAt, declinedRestart }) => !stage && declinedRestart !== ranAt);
  const hasProblems = useProjectStore((state) => errorsOf(state.diagnostics).length > 0);
  return hasApplication && hasChanged && isStill && !hasProblems;
}
