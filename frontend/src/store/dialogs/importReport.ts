import { create } from 'zustand';

/** The project whose import report the user has not closed yet, and the file that was imported last. */
interface ImportReport {
  readonly projectId: string | null;
  readonly file: string;
}

export const useImportReport = create<ImportReport>(() => ({ projectId: null, file: '' }));

export const announceImport = (projectId: string, file: string) =>
  useImportReport.setState({ projectId, file });
/** Closes the report. The name of the file stays: the title shows it while the report fades out. */
export const closeImportReport = () => useImportReport.setState({ projectId: null });
