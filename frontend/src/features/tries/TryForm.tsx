import { Button, Group, Stack, Text, TextInput } from '@mantine/core';
import { type ReactNode, type SubmitEvent, useState } from 'react';
import { useTranslation } from 'react-i18next';
import { LONGEST_S, MOST_VALUES, type TriesProblem } from '@/model/tries';

interface TryFormProps {
  /** The fields for what is tried. */
  readonly children: ReactNode;
  readonly values: readonly string[];
  readonly problem: TriesProblem | null;
  /** The values that do not fit. */
  readonly bad?: readonly string[];
  /** Begins, with the time for each in s. */
  readonly onBegin: (seconds: number) => void;
}

/** What is tried, the time for which each is continued, and a button that begins. */
export function TryForm({ children, values, problem, bad = [], onBegin }: TryFormProps) {
  const { t } = useTranslation('axis');
  const [duration, setDuration] = useState('10');
  const seconds = duration.trim() === '' ? Number.NaN : Number(duration);
  const isTimeGood = seconds > 0 && seconds <= LONGEST_S;
  const begin = (event: SubmitEvent) => {
    event.preventDefault();
    if (problem === null && isTimeGood) onBegin(seconds);
  };
  return (
    <form onSubmit={begin}>
      <Stack gap="xs">
        <Group gap="sm" align="start">
          {children}
          <TextInput
            size="xs"
            w={200}
            inputMode="decimal"
            label={t('tries.duration')}
            value={duration}
            error={isTimeGood ? null : t('tries.badDuration', { most: LONGEST_S })}
            onChange={({ currentTarget }) => setDuration(currentTarget.value)}
            data-testid="tries-duration"
          />
        </Group>
        <Group gap="sm" justify="space-between">
          <Text size="sm" {...(problem ? { c: 'red' } : {})} role="status" data-testid="tries-preview">
            {problem
              ? t(`tries.problem.${problem}`, { most: MOST_VALUES, values: bad.join(', ') })
              : t('tries.preview', { values: values.join(', ') })}
          </Text>
          <Button
            size="compact-sm"
            type="submit"
            disabled={problem !== null || !isTimeGood}
            data-testid="tries-begin"
          >
            {t('tries.begin')}
          </Button>
        </Group>
      </Stack>
    </form>
  );
}
