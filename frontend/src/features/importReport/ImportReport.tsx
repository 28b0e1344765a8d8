import { Modal } from '@mantine/core';
import { useTranslation } from 'react-i18next';
import { closeImportReport, useImportReport } from '@/store/dialogs/importReport';
import { ReportContents } from './ReportContents';

/** The report of an import, shown once when its project is first opened. */
export function ImportReport({ projectId }: { readonly projectId: string }) {
  const { t } = useTranslation('importReport');
  const { projectId: imported, file } = useImportReport();
  return (
    <Modal opened={imported === projectId} onClose={closeImportReport} title={t('title', { file })} size="lg">
      <ReportContents />
    </Modal>
  );
}
