import { Button, Group, NativeSelect, Stack, Text, Textarea, TextInput } from '@mantine/core';
import { type SubmitEvent, useState } from 'react';
import { useTranslation } from 'react-i18next';
import type { PortSpec } from '@/model/ports';
import {
  fitOf,
  listFor,
  LONGEST_S,
  MOST_VALUES,
  rangeAround,
  takesRange,
  valuesOfList,
  valuesOfRange,
} from '@/model/tries';
import { beginTries } from '@/store/moment/rerun/tryMany';
import type { TriedPlace } from '@/store/session/tries';

interface ValuesFormProps {
  readonly port: PortSpec;
  readonly value: string | null;
  readonly place: TriedPlace;
}

/** The values of one port, as a range or a list, and the time for which each is continued. */
export function ValuesForm({ port, value, place }: ValuesFormProps) {
  const { t } = useTranslation('axis');
  const [isRange, setIsRange] = useState(takesRange(port));
  const [range, setRange] = useState(() => rangeAround(port, value));
  const [list, setList] = useState(() => listFor(port));
  const [duration, setDuration] = useState('10');
  const found = isRange ? valuesOfRange(range, port.type) : valuesOfList(list, port.type);
  const values = typeof found === 'string' ? [] : found;
  const bad = values.filter((each) => ['bad', 'range'].includes(fitOf(port, each)));
  const seconds = duration.trim() === '' ? Number.NaN : Number(duration);
  const isTimeGood = seconds > 0 && seconds <= LONGEST_S;
  const problem = typeof found === 'string' ? found : bad.length > 0 ? 'bad' : null;
  const begin = (event: SubmitEvent) => {
    event.preventDefault();
    if (problem === null && isTimeGood) void beginTries(place, values, seconds);
  };
  const end = (name: 'from' | 'to' | 'count') => (
    <TextInput
      key={name}
      size="xs"
      w={110}
      inputMode="decimal"
      label={t(`tries.${name}`)}
      value={range[name]}
      onChange={({ currentTarget }) => setRange({ ...range, [name]: currentTarget.value })}
      data-testid={`tries-${name}`}
    />
  );
  return (
    <form onSubmit={begin}>
      <Stack gap="xs">
        <Group gap="sm" align="start">
          {takesRange(port) ? (
            <NativeSelect
              size="xs"
              label={t('tries.how')}
              value={isRange ? 'range' : 'list'}
              data={[
                { value: 'range', label: t('tries.range') },
                { value: 'list', label: t('tries.list') },
              ]}
              onChange={({ currentTarget }) => setIsRange(currentTarget.value === 'range')}
              data-testid="tries-how"
            />
          ) : null}
          {isRange ? (
            (['from', 'to', 'count'] as const).map(end)
          ) : (
            <Textarea
              size="xs"
              autosize
              minRows={2}
              maxRows={6}
              label={t('tries.listLabel')}
              value={list}
              onChange={({ currentTarget }) => setList(currentTarget.value)}
              data-testid="tries-list"
            />
          )}
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
