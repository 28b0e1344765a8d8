import { useTranslation } from 'react-i18next';
import { closeRunsDialog, useRunsDialog } from '@/store/dialogs/runs';
import { PartDialog } from '@/ui/PartDialog';
import { lazyPart } from '@/ui/parts';

const Contents = lazyPart(async () => (await import('./RunsContents')).RunsContents);

/** A dialogue with the kept runs of the project. */
export function RunsDialog() {
  const { t } = useTranslation('runs');
  const isOpen = useRunsDialog((state) => state.isOpen);
  return (
    <PartDialog isOpen={isOpen} onClose={closeRunsDialog} title={t('title')} closeLabel={t('close')}>
      <Contents />
    </PartDialog>
  );
}
