import { Badge } from '@mantine/core';
import { IconAlertTriangle, IconCheck, IconPlayerStop, IconX } from '@tabler/icons-react';
import { useTranslation } from 'react-i18next';
import type { StoredRun } from '@/api/runs';

type Result = StoredRun['result'];

const COLORS = { success: 'green', failure: 'red', error: 'red', running: 'gray' } as const satisfies Record<
  Result,
  string
>;
const MARKS = { success: IconCheck, failure: IconX, error: IconAlertTriangle, running: IconPlayerStop };

/** How a kept run ended, in words and with a mark. */
export function ResultBadge({ result }: { readonly result: Result }) {
  const { t } = useTranslation('runs');
  const Mark = MARKS[result];
  return (
    <Badge
      size="sm"
      variant="light"
      color={COLORS[result]}
      leftSection={<Mark size={12} aria-hidden="true" />}
      data-result={result}
    >
      {t(`result.${result}`)}
    </Badge>
  );
}
