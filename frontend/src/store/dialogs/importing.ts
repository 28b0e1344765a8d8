import { create } from 'zustand';
import type { PartKind } from '@/api/imports';

/** Files of the user's disk, with their paths below what was chosen or dragged. */
export interface Source {
  readonly name: string;
  readonly files: readonly { readonly path: string; readonly file: File }[];
}

/** The dialogue that imports a robot or a world; `source` is what was dragged onto the page. */
interface Importing {
  readonly isOpen: boolean;
  /** What the user wants; null if the files decide. */
  readonly kind: PartKind | null;
  readonly source: Source | null;
  /** Counts the openings: each begins with an empty form. */
  readonly count: number;
  /** The file that was imported, once it is. */
  readonly finished: string | null;
  /** Whether files are packed, looked at or imported: other files must wait. */
  readonly isBusy: boolean;
}

export const useImporting = create<Importing>(() => ({
  isOpen: false,
  kind: null,
  source: null,
  count: 0,
  finished: null,
  isBusy: false,
}));

export const openImporting = (kind: PartKind | null = null, source: Source | null = null) =>
  useImporting.setState(({ count }) => ({ isOpen: true, kind, source, count: count + 1, finished: null }));
export const finishImporting = (finished: string) => useImporting.setState({ finished });
/** The title stays while the dialogue fades out; the dragged files need not be kept. */
export const closeImporting = () => useImporting.setState({ isOpen: false, source: null });
