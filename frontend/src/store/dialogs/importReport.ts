import { create } from 'zustand';

/** The project whose report is still to be read, and the file that was imported last. */
interface ImportReport {
  readonly projectId: string | null;
  readonly file: string;
}

export const useImportReport = create<ImportReport>(() => ({ projectId: null, file: '' }));

export const announceImport = (projectId: string, file: string) =>
  useImportReport.setState({ projectId, file });
/** Returns the name of the file stays: it is in the title while the report fades out. */
export const closeImportReport = () => useImportReport.setState({ projectId: null });
