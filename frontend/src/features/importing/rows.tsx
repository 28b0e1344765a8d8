import { IconAlertTriangle, IconCheck, IconInfoCircle } from '@tabler/icons-react';
import type { ReportLine } from '@/api/imports';
import classes from '@/features/importReport/importReport.module.css';
import type { ReportRow } from '@/features/importReport/ReportSections';
import { placeOf } from './failure';

const ICONS = { warning: IconAlertTriangle, note: IconInfoCircle, fine: IconCheck } as const;

/** Returns the rows of a report: each line with its place in the upload. */
export function rowsOf(lines: readonly ReportLine[], severity: keyof typeof ICONS): readonly ReportRow[] {
  const Icon = ICONS[severity];
  return lines.map(({ file, line, text }, index) => {
    const place = placeOf(file, line);
    return {
      key: `${place} ${index}`,
      text: place ? `${place}: ${text}` : text,
      icon: <Icon size={16} aria-hidden="true" />,
      content: (
        <span>
          {place ? <span className={classes['place']}>{place}</span> : null} {text}
        </span>
      ),
      severity: severity === 'warning' ? 'warning' : 'note',
    };
  });
}
