import { useEffect, useRef } from 'react';
import type { Diagnostic } from '@/api/types';
import type { Fault } from '@/generated/messages';
import { openBlock } from '@/store/problems/open';
import { useProjectStore } from '@/store/project';
import { openTree } from '@/store/project/navigation';
import { errorsOf } from '@/store/project/problems';
import { followPorts } from '@/store/run/portSync';
import { followRanTexts } from '@/store/run/ranTexts';
import { useRunStore } from '@/store/run/store';
import { launchNodeFaults } from '@/store/session/reduce';
import { useSessionStore } from '@/store/session/store';

import { followRunning } from './following';

interface Frame {
  showPanel: (panel: 'problems' | 'console') => void;
  openFile: (path: string, line?: number) => void;
}

/** Shows an error to the user: opens the list of problems, or the line that raised the exception. */
export function useRunReactions({ showPanel, openFile }: Frame): void {
  const failure = useRunStore((state) => state.failure);
  const fault = useSessionStore((state) => state.faults.at(-1));

  useEffect(followRunning, []);
  useEffect(forgetWithTheFirstEdit, []);
  useEffect(followPorts, []);
  useEffect(followRanTexts, []);
  useEffect(() => leaveRuns, []);

  useEffect(() => {
    if (!failure || failure.diagnostics.length === 0) return;
    const { actions, setChecked } = useProjectStore.getState();
    setChecked({ diagnostics: failure.diagnostics, actions });
    showPanel('problems');
    leadTo(failure.diagnostics);
    // The frame's functions never change, so they are not listed as dependencies.
    // eslint-disable-next-line react-hooks/exhaustive-deps
  }, [failure]);

  const told = useRef(new WeakSet<Fault>());
  useEffect(() => {
    // When the user dismisses a fault, an older one becomes the last again, and must not be shown a second
    // time.
    if (!fault || told.current.has(fault)) return;
    useSessionStore.getState().faults.forEach((each) => told.current.add(each));
    // The end of a launch node does not end the run, so it must not change what the user sees.
    if (!fault.file || fault.line <= 0 || fault.kind === 'process') return;
    if (fault.file in useProjectStore.getState().files) openFile(fault.file, fault.line);
    // eslint-disable-next-line react-hooks/exhaustive-deps
  }, [fault]);
}

/** Forgets what concerns the runs of this project, which is closed: the next one has other blocks and edits. */
function leaveRuns(): void {
  useRunStore.setState({ failure: null, ranAt: 0, declinedRestart: null, readTakeOver: '' });
}

/** Leads to the block of the first error, which the message names, and into the field of its port. */
function leadTo(diagnostics: readonly Diagnostic[]): void {
  const [first] = errorsOf(diagnostics);
  const { diagrams } = useProjectStore.getState();
  const { tree, node, port } = first ?? {};
  if (!tree || !(tree in diagrams)) return;
  if (node && diagrams[tree]?.nodes[node]) openBlock({ tree, node, ...(port ? { port } : {}) });
  else openTree(tree);
}

/**
 * Removes the messages about the last run at the first edit, since the user has reacted to them; those of
 * launch nodes stay. Returns a function that stops it.
 */
function forgetWithTheFirstEdit(): () => void {
  return useProjectStore.subscribe(({ changeCounter, projectId }, before) => {
    if (changeCounter === before.changeCounter || projectId !== before.projectId) return;
    if (useRunStore.getState().stage !== null) return;
    const session = useSessionStore.getState();
    useRunStore.setState({ failure: null });
    if (session.faults.length > 0 || session.executorReason !== '')
      useSessionStore.setState({ faults: launchNodeFaults(session), executorReason: '' });
  });
}
