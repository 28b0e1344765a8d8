import type { Upload } from '@/api/imports';
import { LIMITS } from '@/generated/limits';
import { crc32, zipDirectory, zipHeader, type ZipEntry } from '@/model/zip';
import type { Source } from '@/store/dialogs/importing';

/** Why files cannot be sent. */
export class PackError extends Error {
  override readonly name = 'PackError';

  constructor(
    readonly reason: 'empty' | 'files' | 'bytes' | 'unread',
    readonly value: number | string,
  ) {
    super(reason);
  }
}

/** Returns the sum of the files' sizes. */
const sizeOf = (source: Source): number => source.files.reduce((sum, { file }) => sum + file.size, 0);

/** Throws if the files are none, or more than the server takes; nothing has been read then. */
export function checkSource(source: Source): void {
  if (source.files.length === 0) throw new PackError('empty', 0);
  if (source.files.length > LIMITS.archive_entries) throw new PackError('files', LIMITS.archive_entries);
  if (sizeOf(source) > LIMITS.import_upload_bytes) throw new PackError('bytes', LIMITS.import_upload_bytes);
}

async function bytesOf(file: File, path: string): Promise<Uint8Array> {
  try {
    return new Uint8Array(await file.arrayBuffer());
  } catch {
    // It was moved, or may not be read.
    throw new PackError('unread', path);
  }
}

/**
 * Returns the files as one: a single file as it is, several as a zip.
 *
 * @param onProgress Called with the share of the bytes that are read.
 */
export async function pack(
  source: Source,
  signal: AbortSignal,
  onProgress: (share: number) => void,
): Promise<Upload> {
  checkSource(source);
  const [only, ...others] = source.files;
  if (only && others.length === 0 && !only.path.includes('/')) return { name: only.path, data: only.file };
  const all = Math.max(sizeOf(source), 1);
  const entries: ZipEntry[] = [];
  const parts: BlobPart[] = [];
  let read = 0;
  for (const { path, file } of source.files) {
    signal.throwIfAborted();
    const bytes = await bytesOf(file, path);
    const entry = { path, size: bytes.length, crc: crc32(bytes) };
    entries.push(entry);
    parts.push(zipHeader(entry), file);
    read += bytes.length;
    onProgress(read / all);
  }
  return { name: `${source.name}.zip`, data: new Blob([...parts, ...zipDirectory(entries)]) };
}
