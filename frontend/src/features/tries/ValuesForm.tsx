import { NativeSelect, Textarea, TextInput } from '@mantine/core';
import { useState } from 'react';
import { useTranslation } from 'react-i18next';
import type { PortSpec } from '@/model/ports';
import { fitOf, listFor, rangeAround, takesRange, valuesOfList, valuesOfRange } from '@/model/tries';
import { beginTries } from '@/store/moment/rerun/tryMany';
import type { TriedPlace } from '@/store/session/tries';
import { TryForm } from './TryForm';

interface ValuesFormProps {
  readonly port: PortSpec;
  readonly value: string | null;
  readonly place: TriedPlace;
}

/** The values of one port, as a range or a list. */
export function ValuesForm({ port, value, place }: ValuesFormProps) {
  const { t } = useTranslation('axis');
  const [isRange, setIsRange] = useState(takesRange(port));
  const [range, setRange] = useState(() => rangeAround(port, value));
  const [list, setList] = useState(() => listFor(port));
  const found = isRange ? valuesOfRange(range, port.type) : valuesOfList(list, port.type);
  const values = typeof found === 'string' ? [] : found;
  const bad = values.filter((each) => ['bad', 'range'].includes(fitOf(port, each)));
  const problem = typeof found === 'string' ? found : bad.length > 0 ? 'bad' : null;
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
    <TryForm
      values={values}
      problem={problem}
      bad={bad}
      onBegin={(seconds) => void beginTries(place, values, seconds)}
    >
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
    </TryForm>
  );
}
