import { useEffect, useState } from 'react';
import { api } from '@/api/client';
import { watchPython } from '@/store/problems/lint';
import { useProjectStore } from '@/store/project';
import { loadOffered } from '@/store/project/offered';
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
  useEffect(() => {
    const loading = new AbortController();
    let unfollow: (() => void) | null = null;
    let unwatch: (() => void) | null = null;
    api.getProject(projectId, loading.signal).then(
      (detail) => {
        useProjectStore.getState().load(detail);
        startAutosave();
        unwatch = watchPython();
        restoreDraft(detail);
        setOpening({ kind: 'open', joined: reattach(projectId) });
        unfollow = followRevisions(projectId, notifyRemoteSave, showServerNotice);
        void loadOffered();
      },
      (error: Error) => {
        if (error.name !== 'AbortError') setOpening({ kind: 'failed', error });
      },
    );
    return () => {
      loading.abort();
      unfollow?.();
      unwatch?.();
      stopAutosave();
      leave();
    };
  }, [projectId]);
  return opening;
}
