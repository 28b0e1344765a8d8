import { create } from 'zustand';
import type { ImportedProject } from '@/api/types';

export type Proposal = ImportedProject['proposal'];

/** The project whose report is still to be read, and what was imported last. */
interface ImportReport {
  readonly projectId: string | null;
  readonly file: string;
  /** The universe that suits the topics of the actions; null if none is asked for by them. */
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
