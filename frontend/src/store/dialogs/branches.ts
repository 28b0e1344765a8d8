import { create } from 'zustand';
import type { Branch } from '@/generated/messages';
import { send } from '@/store/session/connection';
import { useSessionStore } from '@/store/session/store';
import { extent, lookNow } from '@/store/moment/looking';
import { useSource } from '@/store/moment/source';

/** The branch whose form is open, by its run; null while none is. */
export const useBranchForm = create<{ readonly run: string | null }>(() => ({ run: null }));

/** The shown branch of the session; null if the shown run is none. */
export function shownBranch(): Branch | null {
  const run = extent()?.run;
  if (useSource.getState().kept !== null) return null;
  return useSessionStore.getState().branches.find((branch) => branch.run === run) ?? null;
}

/** Whether the shown run is a branch that this page may name and throw away. */
export function canChangeBranch(): boolean {
  const { connection, introspection } = useSessionStore.getState();
  return connection === 'open' && introspection?.role === 'driver' && shownBranch() !== null;
}

/** Opens the form for the shown branch. */
export function changeBranch(): void {
  const branch = shownBranch();
  if (branch && canChangeBranch()) useBranchForm.setState({ run: branch.run });
}

export const nameBranch = (run: string, name: string) => send('name_branch', { run, name });

/** Throws a branch away, with its recording, and shows the present. */
export async function dropBranch(run: string): Promise<void> {
  await send('drop_branch', { run });
  lookNow();
}
