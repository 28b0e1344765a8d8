import { Button, Group, NativeSelect } from '@mantine/core';
import { useQuery } from '@tanstack/react-query';
import { useState } from 'react';
import { useTranslation } from 'react-i18next';
import { revisions } from '@/api/revisions';
import { refusalText } from '@/i18n/evaluationReasons';
import { timeAgo } from '@/i18n/timeAgo';

interface Props {
  readonly projectId: string;
  readonly before: number;
  /** The revision that was evaluated before this one, if there is one. */
  readonly suggested: number | null;
  readonly onCompare: (revision: number) => void;
  readonly onCancel: () => void;
}

/** Chooses the older revision with which an evaluation is compared. */
export function CompareForm({ projectId, before, suggested, onCompare, onCancel }: Props) {
  const { t, i18n } = useTranslation('evaluate');
  const [chosen, setChosen] = useState<number | null>(null);
  const found = useQuery({
    queryKey: ['revisions', projectId, 'before', before],
    queryFn: ({ signal }) => revisions.list(projectId, '', before, signal),
  });
  const options = (found.data?.items ?? []).map(({ number, label, message, created_at }) => ({
    value: String(number),
    label: [
      t('revision', { revision: number }),
      number === suggested ? t('compare.evaluated') : '',
      label || message,
      timeAgo(created_at, i18n.language),
    ]
      .filter(Boolean)
      .join(' · '),
  }));
  if (found.data && suggested !== null && !options.some(({ value }) => value === String(suggested)))
    options.push({
      value: String(suggested),
      label: `${t('revision', { revision: suggested })} · ${t('compare.evaluated')}`,
    });
  const first = options[0] ? Number(options[0].value) : null;
  const revision = chosen ?? suggested ?? first;
  return (
    <Group gap={6} align="flex-end">
      {found.isError ? <p role="alert">{refusalText(t, found.error)}</p> : null}
      <NativeSelect
        size="xs"
        label={t('compare.with')}
        value={String(revision ?? '')}
        onChange={({ currentTarget: { value } }) => setChosen(Number(value))}
        data={options}
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
