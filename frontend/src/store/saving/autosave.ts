import { api } from '@/api/client';
import { ApiError } from '@/api/errors';
import type { FileChange } from '@/api/types';
import { serverReason } from '@/i18n/serverReason';
import { useProjectStore } from '@/store/project';
import { clearDraft, writeDraft } from './drafts';
import { useSavingStore, type SaveState } from './store';

const SAVE_AFTER_MS = 600;
/**
 * The delay before edits are kept in the browser: the page draws an edit first, and fast typing is stored
 * only once.
 */
const KEEP_AFTER_MS = 80;
const RETRY_AFTER_MS = 4000;

let timer: ReturnType<typeof setTimeout> | undefined;
let keeping: ReturnType<typeof setTimeout> | undefined;
let inFlight: Promise<void> | null = null;
let stopWatching: (() => void) | null = null;

const setState = (state: SaveState) => useSavingStore.setState({ state });

/** Saves the open project shortly after each edit, until `stopAutosave` is called. */
export function startAutosave(): void {
  stopAutosave();
  let counter = useProjectStore.getState().changeCounter;
  stopWatching = useProjectStore.subscribe((project) => {
    if (project.changeCounter === counter) return;
    counter = project.changeCounter;
    onEdited();
  });
  window.addEventListener('beforeunload', keepDraftNow);
  document.addEventListener('visibilitychange', saveWhenHidden);
  window.addEventListener('online', saveSoon);
}

export function stopAutosave(): void {
  clearTimeout(timer);
  keepDraftNow();
  stopWatching?.();
  stopWatching = null;
  window.removeEventListener('beforeunload', keepDraftNow);
  document.removeEventListener('visibilitychange', saveWhenHidden);
  window.removeEventListener('online', saveSoon);
  setState({ kind: 'saved' });
}

/** Saves all edits now; resolves when the server has them, otherwise rejects. */
export async function saveNow(): Promise<void> {
  clearTimeout(timer);
  // Only one request runs at a time: each needs the revisions that the previous one made.
  while (inFlight) await inFlight.catch(() => undefined);
  inFlight = save().finally(() => {
    inFlight = null;
  });
  return inFlight;
}

/** Runs another request that makes a revision while no save is in progress. */
export async function asSave(write: () => Promise<void>): Promise<void> {
  clearTimeout(timer);
  while (inFlight) await inFlight.catch(() => undefined);
  setState({ kind: 'saving' });
  inFlight = write().finally(() => {
    inFlight = null;
    onSaved();
  });
  return inFlight;
}

function onEdited(): void {
  const { state } = useSavingStore.getState();
  if (state.kind !== 'conflict') setState(inFlight ? { kind: 'saving' } : { kind: 'dirty' });
  keeping ??= setTimeout(keepDraft, KEEP_AFTER_MS);
  saveSoon();
}

function saveSoon(delay: number | Event = SAVE_AFTER_MS): void {
  clearTimeout(timer);
  // While a conflict waits for the user's choice, another save would only cause the same conflict.
  if (useSavingStore.getState().state.kind === 'conflict') return;
  timer = setTimeout(
    () => void saveNow().catch(() => undefined),
    typeof delay === 'number' ? delay : SAVE_AFTER_MS,
  );
}

function saveWhenHidden(): void {
  if (!document.hidden) return;
  keepDraftNow();
  if (useSavingStore.getState().state.kind === 'dirty') saveSoon(0);
}

/** Stores pending edits in the browser at once. */
function keepDraftNow(): void {
  if (keeping !== undefined) keepDraft();
}

function keepDraft(): void {
  clearTimeout(keeping);
  keeping = undefined;
  const { projectId, pendingChanges } = useProjectStore.getState();
  if (projectId) writeDraft(projectId, pendingChanges());
}

async function save(): Promise<void> {
  const { projectId, pendingChanges, applySaved } = useProjectStore.getState();
  if (!projectId) return;
  const files = pendingChanges();
  if (files.length === 0) {
    clearDraft(projectId);
    return setState({ kind: 'saved' });
  }
  setState({ kind: 'saving' });
  try {
    const result = await api.saveChanges(projectId, { message: messageFor(files), files });
    if (useProjectStore.getState().projectId !== projectId) return;
    applySaved(files, result);
    onSaved();
  } catch (error) {
    onRefused(error);
    throw error;
  }
}

function onSaved(): void {
  keepDraft();
  const isDone = useProjectStore.getState().pendingChanges().length === 0;
  setState(isDone ? { kind: 'saved' } : { kind: 'dirty' });
  if (!isDone) saveSoon();
}

function onRefused(error: unknown): void {
  if (error instanceof ApiError && error.code === 'revision_conflict') {
    return setState({ kind: 'conflict', conflicts: error.conflicts });
  }
  const reason = serverReason(error);
  setState({ kind: 'failed', code: error instanceof ApiError ? error.code : 'unknown', reason });
  if (error instanceof ApiError && (error.isOffline || error.isRestarted || error.status >= 500))
    saveSoon(RETRY_AFTER_MS);
}

/** Returns the message that this save gets in the history. */
function messageFor(files: readonly FileChange[]): string {
  const names = files.map((file) => file.path.split('/').at(-1) ?? file.path);
  return names.length <= 3 ? `Edit ${names.join(', ')}` : `Edit ${names.length} files`;
}
