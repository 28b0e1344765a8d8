import { create } from 'zustand';
import type { ImportedProject } from '@/api/types';

export type Proposal = ImportedProject['proposal'];

/** The project whose import report is unread, and the last import. */
interface ImportReport {
  readonly projectId: string | null;
  readonly file: string;
  /** The universe that suits the topics of the actions; null if they suggest none. */
  readonly proposal: Proposal;
  /** Why a tree of py_trees came in as one block; empty if it is a tree of blocks. */
  readonly oneBlock: string;
}

export const useImportReport = create<ImportReport>(() => ({
  projectId: null,
  file: '',
  proposal: null,
  oneBlock: '',
}));

export const announceImport = (projectId: string, file: string, proposal: Proposal, oneBlock = '') =>
  useImportReport.setState({ projectId, file, proposal, oneBlock });
/** The name of the file stays: it is in the title while the report fades out. */
export const closeImportReport = () => useImportReport.setState({ projectId: null });
