import { useTranslation } from 'react-i18next';
import { closeExportDialog, useExportDialog } from '@/store/dialogs/export';
import { PartDialog } from '@/ui/PartDialog';
import { lazyPart } from '@/ui/parts';

const Contents = lazyPart(async () => (await import('./ExportContents')).ExportContents);

/** A dialogue with the contents of an export before the download. */
export function ExportDialog() {
  const { t } = useTranslation('export');
  const isOpen = useExportDialog((state) => state.isOpen);
  return (
    <PartDialog isOpen={isOpen} onClose={closeExportDialog} title={t('title')} closeLabel={t('close')}>
      <Contents />
    </PartDialog>
  );
}
