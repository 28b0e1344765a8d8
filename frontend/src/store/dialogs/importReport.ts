import { create } from 'zustand';
import type { ImportedProject } from '@/api/types';

export type Proposal = ImportedProject['proposal'];

/** The project whose import report is unread, and the last import. */
interface ImportReport {
  readonly projectId: string | null;
  readonly file: string;
  /** The universe that suits the topics of the actions; null if they suggest none. */
  readonly proposal: Proposal;
}

export const useImportReport = create<ImportReport>(() => ({
  projectId: null,
  file: '',
  proposal: null,
}));

export const announceImport = (projectId: string, file: string, proposal: Proposal) =>
  useImportReport.setState({ projectId, file, proposal });
/** The name of the file stays: it is in the title while the report fades out. */
export const closeImportReport = () => useImportReport.setState({ projectId: null });
