import { useTranslation } from 'react-i18next';
import type { ReportLine } from '@/api/imports';
import { ReportSections } from '@/features/importReport/ReportSections';
import { rowsOf } from './rows';

/** What of an upload is not looked at. */
export function LeftOut({ lines }: { readonly lines: readonly ReportLine[] }) {
  const { t } = useTranslation('importing');
  return (
    <ReportSections
      parts={[
        { heading: t('skipped', { count: lines.length }), rows: rowsOf(lines, 'note'), isFolded: true },
      ]}
    />
  );
}
