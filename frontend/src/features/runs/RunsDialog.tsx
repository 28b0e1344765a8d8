import { useTranslation } from 'react-i18next';
import { closeRunsDialog, useRunsDialog } from '@/store/dialogs/runs';
import { PartDialog } from '@/ui/PartDialog';
import { lazyPart } from '@/ui/parts';
import { LogDrop } from './LogDrop';

const Contents = lazyPart(async () => (await import('./RunsContents')).RunsContents);

/** A dialogue with the kept runs of the project; a log that is dropped on the page is opened, too. */
export function RunsDialog() {
  const { t } = useTranslation('runs');
  const isOpen = useRunsDialog((state) => state.isOpen);
  return (
    <>
      <LogDrop />
      <PartDialog isOpen={isOpen} onClose={closeRunsDialog} title={t('title')} closeLabel={t('close')}>
        <Contents />
      </PartDialog>
    </>
  );
}
