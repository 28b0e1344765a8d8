import { Button, Group, NativeSelect } from '@mantine/core';
import { useQuery } from '@tanstack/react-query';
import { useState } from 'react';
import { useTranslation } from 'react-i18next';
import { revisions } from '@/api/revisions';
import { timeAgo } from '@/i18n/timeAgo';

interface Props {
  readonly projectId: string;
  readonly before: number;
  readonly onCompare: (revision: number) => void;
  readonly onCancel: () => void;
}

/** Chooses the older revision with which an evaluation is compared. */
export function CompareForm({ projectId, before, onCompare, onCancel }: Props) {
  const { t, i18n } = useTranslation('evaluate');
  const [chosen, setChosen] = useState<number | null>(null);
  const found = useQuery({
    queryKey: ['revisions', projectId, 'before', before],
    queryFn: ({ signal }) => revisions.list(projectId, '', before, signal),
  });
  const items = found.data?.items ?? [];
  const revision = chosen ?? items[0]?.number ?? null;
  return (
    <Group gap={6} align="flex-end">
      <NativeSelect
        size="xs"
        label={t('compare.with')}
        value={String(revision ?? '')}
        onChange={({ currentTarget: { value } }) => setChosen(Number(value))}
        data={items.map(({ number, label, message, created_at }) => ({
          value: String(number),
          label: [t('revision', { revision: number }), label || message, timeAgo(created_at, i18n.language)]
            .filter(Boolean)
            .join(' · '),
        }))}
      />
      <Button
        size="compact-sm"
        disabled={revision === null}
        onClick={() => revision !== null && onCompare(revision)}
      >
        {t('compare.do')}
      </Button>
      <Button size="compact-sm" variant="default" onClick={onCancel}>
        {t('compare.cancel')}
      </Button>
    </Group>
  );
}
