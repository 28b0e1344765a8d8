import { create } from 'zustand';

/** The project that was just imported, and the file that it came from; its report is still to be read. */
interface ImportReport {
  readonly projectId: string | null;
  readonly file: string;
}

export const useImportReport = create<ImportReport>(() => ({ projectId: null, file: '' }));

export const announceImport = (projectId: string, file: string) =>
  useImportReport.setState({ projectId, file });
export const closeImportReport = () => useImportReport.setState({ projectId: null, file: '' });
