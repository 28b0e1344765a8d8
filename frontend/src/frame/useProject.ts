import { useQueryClient } from '@tanstack/react-query';
import { useEffect, useState } from 'react';
import { api } from '@/api/client';
import { ME } from '@/features/accounts/useMe';
import { watchPython } from '@/store/problems/lint';
import { useProjectStore } from '@/store/project';
import { followOffered } from '@/store/project/offered';
import { startAutosave, stopAutosave } from '@/store/saving/autosave';
import { restoreDraft } from '@/store/saving/conflicts';
import { followRevisions } from '@/store/saving/live';
import { showServerNotice } from './showServerNotice';
import { notifyRemoteSave } from './notifyRemoteSave';
import { leave, reattach } from '@/store/session/connection';

/** Of an open project, `joined` resolves when the page has joined its session, or knows that there is none. */
type Opening =
  { kind: 'loading' } | { kind: 'open'; joined: Promise<void> } | { kind: 'failed'; error: Error };

/** Opens a project: loads it, restores unsaved edits, starts autosaving, and joins its running session. */
export function useProject(projectId: string): Opening {
  const [opening, setOpening] = useState<Opening>({ kind: 'loading' });
  const queries = useQueryClient();
  useEffect(() => {
    const loading = new AbortController();
    let unfollow: (() => void) | null = null;
    let unwatch: (() => void) | null = null;
    let unoffer: (() => void) | null = null;
    api.getProject(projectId, loading.signal).then(
      (detail) => {
        useProjectStore.getState().load(detail);
        startAutosave();
        unwatch = watchPython();
        restoreDraft(detail);
        // A guest has no sessions.
        const joined = queries
          .fetchQuery(ME)
          .then(({ role }) => (role === 'guest' || loading.signal.aborted ? undefined : reattach(projectId)))
          .catch(() => undefined); // without an answer the page opens without a session, as after its end
        setOpening({ kind: 'open', joined });
        unfollow = followRevisions(projectId, notifyRemoteSave, showServerNotice);
        unoffer = followOffered();
      },
      (error: Error) => {
        if (error.name !== 'AbortError') setOpening({ kind: 'failed', error });
      },
    );
    return () => {
      loading.abort();
      unfollow?.();
      unwatch?.();
      unoffer?.();
      stopAutosave();
      leave();
    };
  }, [projectId, queries]);
  return opening;
}
