import type { Source } from '@/store/dialogs/importing';
import { PackError } from './pack';

/** Folders that no robot and no world needs. */
const SKIPPED = new Set(['.git', '.svn', '.hg', '__pycache__', 'node_modules', '__MACOSX']);
const IMPORTABLE = /\.(zip|urdf|xacro|sdf|world|ya?ml)$/i;

const pathOf = (fullPath: string) => fullPath.replace(/^\//, '');
const isSkipped = (path: string) => path.split('/').some((part) => SKIPPED.has(part));

/** Returns whether dropped names may be a robot or a world; a folder has no such name. */
export const isImportable = (name: string): boolean => IMPORTABLE.test(name);

function named(files: Source['files']): Source {
  const [first] = files;
  const folder = first?.path.includes('/') ? first.path.split('/')[0] : undefined;
  const isOneFolder = folder !== undefined && files.every(({ path }) => path.startsWith(`${folder}/`));
  return { name: (isOneFolder ? folder : first?.path) ?? '', files };
}

/** Returns the files that a field of the page gave. */
export const sourceOfFiles = (files: readonly File[]): Source =>
  named(
    files
      .map((file) => ({ path: file.webkitRelativePath || file.name, file }))
      .filter(({ path }) => !isSkipped(path)),
  );

/** Waits for what the browser reads of an entry. */
async function readOf<T>(
  { fullPath }: FileSystemEntry,
  read: (done: (value: T) => void, fail: () => void) => void,
) {
  return new Promise<T>((done, fail) => {
    read(done, () => fail(new PackError('unread', pathOf(fullPath))));
  });
}

/** A browser gives the entries of a folder in portions. */
async function entriesOf(folder: FileSystemDirectoryEntry): Promise<FileSystemEntry[]> {
  const reader = folder.createReader();
  const found: FileSystemEntry[] = [];
  for (;;) {
    const portion = await readOf<FileSystemEntry[]>(folder, (done, fail) => reader.readEntries(done, fail));
    if (portion.length === 0) return found;
    found.push(...portion);
  }
}

async function walk(entry: FileSystemEntry, most: number, found: { path: string; file: File }[]) {
  const path = pathOf(entry.fullPath);
  if (isSkipped(path) || found.length > most) return;
  if (entry.isFile) {
    const file = await readOf<File>(entry, (done, fail) => (entry as FileSystemFileEntry).file(done, fail));
    found.push({ path, file });
  } else for (const each of await entriesOf(entry as FileSystemDirectoryEntry)) await walk(each, most, found);
}

/**
 * Returns what was dropped, with the files of folders; stops soon after `most` files. The browser forgets the
 * transfer after its event: its entries are asked for before anything is awaited.
 */
export async function sourceOfDrop(transfer: DataTransfer, most: number): Promise<Source> {
  const entries = [...transfer.items]
    .filter(({ kind }) => kind === 'file')
    .map((item) => item.webkitGetAsEntry())
    .filter((entry) => entry !== null);
  if (entries.length === 0) return sourceOfFiles([...transfer.files]);
  const found: { path: string; file: File }[] = [];
  for (const entry of entries) await walk(entry, most, found);
  return named(found);
}

/** Returns whether a drop may be a robot or a world: a folder, or a file with such a name. */
export const hasImportable = (transfer: DataTransfer): boolean =>
  [...transfer.items].some((item) => item.webkitGetAsEntry()?.isDirectory) ||
  [...transfer.files].some(({ name }) => isImportable(name));
