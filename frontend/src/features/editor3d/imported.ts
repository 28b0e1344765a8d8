import { notifications } from '@mantine/notifications';
import { create } from 'zustand';
import type { PartKind } from '@/api/imports';
import { reasonOf } from '@/api/reason';
import { t } from '@/i18n';
import { useProjectStore } from '@/store/project';
import type { ProjectData } from '@/store/project/state';
import { restoreRevision } from '@/store/revisions/restore';
import type { WrittenPart } from '@/store/saving/importPart';
import { useUniverseChoice } from '@/store/run/universeChoice';
import { undoNotification } from '@/ui/undoNotification';
import { closeTab } from '@/workspace/tabs';
import { isReadOnly, restart, travel, type Editor } from './editing';

const MANIFEST = 'project.json';

/** The project as it was before an import. */
export type Before = Pick<ProjectData, 'files' | 'settings'>;

/** An import as one step of undo: its files, and the revisions before and after it. */
interface ImportStep {
  readonly projectId: string;
  readonly kind: PartKind;
  readonly name: string;
  readonly path: string;
  readonly paths: readonly string[];
  /** Those of the paths that were there before. */
  readonly existed: readonly string[];
  /** The texts of its files as they were imported, as far as the page has them. */
  readonly texts: Readonly<Record<string, string>>;
  /** The revision in which the import changed the settings; null if it did not. */
  readonly settingsRevision: number | null;
  /** The robot or universe that the project used before; undefined for none. */
  readonly usedBefore: string | undefined;
  readonly before: number;
  readonly after: number;
}

/** The last import of this page; Undo in its document takes it back while that is not changed. */
export const useImported = create<{ step: ImportStep | null }>(() => ({ step: null }));

/** Remembers an import; one of the same document that follows it, such as a simpler one, is part of its step. */
export function recordImport(part: WrittenPart, kind: PartKind, before: Before): void {
  const { projectId, files } = useProjectStore.getState();
  const last = useImported.getState().step;
  const again =
    last !== null && last.path === part.path && last.after === part.previous_revision ? last : null;
  const known = again?.paths ?? [];
  const touched = [...part.paths, ...part.removed].filter((path) => !known.includes(path));
  useImported.setState({
    step: {
      projectId: projectId ?? '',
      kind,
      name: part.name,
      path: part.path,
      paths: [...known, ...touched],
      existed: [...(again?.existed ?? []), ...touched.filter((path) => path in before.files)],
      texts: textsNow(part.paths),
      settingsRevision:
        files[MANIFEST]?.revision === part.revision ? part.revision : (again?.settingsRevision ?? null),
      usedBefore: again ? again.usedBefore : before.settings?.[kind],
      before: again ? again.before : part.previous_revision,
      after: part.revision,
    },
  });
  restart(part.path);
}

function textsNow(paths: readonly string[]): Readonly<Record<string, string>> {
  const { currentText } = useProjectStore.getState();
  return Object.fromEntries(
    paths.flatMap((path) => {
      const text = currentText(path);
      return text === null ? [] : [[path, text]];
    }),
  );
}

const isOpen = (step: ImportStep): boolean => step.projectId === useProjectStore.getState().projectId;

/** Returns whether Undo in a document takes its import back: none of its texts is changed since. */
export function isImportOf(step: ImportStep | null, path: string): boolean {
  if (step === null || step.path !== path || !isOpen(step)) return false;
  const { currentText } = useProjectStore.getState();
  return Object.entries(step.texts).every(([each, text]) => currentText(each) === text);
}

/** Undoes or redoes a step of a document; where there is none to undo, takes its import back. */
export function travelOrUndoImport(editor: Editor, direction: 'undo' | 'redo'): void {
  const hasOwn = editor.store.getState().undoStack.past.length > 0;
  const isImport = isImportOf(useImported.getState().step, editor.path) && !isReadOnly();
  if (direction === 'undo' && !hasOwn && isImport) void undoImport();
  else travel(editor, direction);
}

/** Returns whether the settings are as the import has left them. */
function areSettingsOf({ settingsRevision }: ImportStep): boolean {
  const { files, currentText } = useProjectStore.getState();
  const entry = files[MANIFEST];
  return entry?.revision === settingsRevision && currentText(MANIFEST) === entry.savedText;
}

/** Returns the paths that are there, now or before the import: the server refuses others. */
function pathsNow(step: ImportStep): readonly string[] {
  const { files, revision } = useProjectStore.getState();
  const isLoaded = revision >= step.after;
  const paths = step.paths.filter((path) => !isLoaded || path in files || step.existed.includes(path));
  return areSettingsOf(step) ? [...paths, MANIFEST] : paths;
}

/** Lets the project use another robot or universe in place of one. */
function replaceUsed(kind: PartKind, name: string | undefined, inPlaceOf: string | undefined): boolean {
  const { settings, setSettings } = useProjectStore.getState();
  if (settings?.[kind] !== inPlaceOf) return false;
  setSettings({ [kind]: name });
  return true;
}

/** Restores files of a revision, and returns the one before; without paths, the server would restore all. */
async function restoreOnly(revision: number, paths: readonly string[]): Promise<number> {
  if (paths.length === 0) return useProjectStore.getState().revision;
  return (await restoreRevision(revision, paths)).previous;
}

/** Takes the last import back as a new revision; a notification offers to bring it back. */
export async function undoImport(): Promise<void> {
  const { step } = useImported.getState();
  if (step === null || !isOpen(step)) return;
  useImported.setState({ step: null });
  const { universe, robot } = useUniverseChoice.getState();
  if ((step.kind === 'robot' ? robot : universe) === step.name) {
    useUniverseChoice.setState({ universe: null, robot: null });
  }
  const paths = pathsNow(step);
  try {
    await restoreOnly(step.before, paths);
    restart(step.path);
    const { files } = useProjectStore.getState();
    for (const path of step.paths) if (!(path in files)) closeTab({ kind: 'file', path });
    // Somebody has changed the settings since: they only must not name what is gone.
    const isReset =
      !paths.includes(MANIFEST) &&
      !(step.path in files) &&
      replaceUsed(step.kind, step.usedBefore, step.name);
    undoNotification({
      message: t('importing:undone', { name: step.name }),
      undoLabel: t('importing:redo'),
      undo: () => void redoImport(step, paths, isReset),
    });
  } catch (error) {
    useImported.setState({ step });
    tell(t('importing:undoFailed'), error);
  }
}

async function redoImport(step: ImportStep, paths: readonly string[], isReset: boolean): Promise<void> {
  if (!isOpen(step)) return;
  try {
    const before = await restoreOnly(step.after, paths);
    restart(step.path);
    if (isReset) replaceUsed(step.kind, step.name, step.usedBefore);
    const { revision, files } = useProjectStore.getState();
    const settingsRevision = paths.includes(MANIFEST) ? (files[MANIFEST]?.revision ?? null) : null;
    useImported.setState({ step: { ...step, settingsRevision, before, after: revision } });
  } catch (error) {
    tell(t('importing:redoFailed'), error);
  }
}

const tell = (title: string, error: unknown) =>
  notifications.show({ color: 'red', title, message: reasonOf(error) });
