import { Text, TextInput } from '@mantine/core';
import { useState } from 'react';
import { useTranslation } from 'react-i18next';
import { seedsFrom } from '@/model/tries';
import { beginSeeds } from '@/store/moment/rerun/tryMany';
import type { TriedMoment } from '@/store/session/tries';
import { TryForm } from './TryForm';

/** The seeds that are tried, and what a new seed changes. */
export function SeedsForm({ moment }: { readonly moment: TriedMoment }) {
  const { t } = useTranslation('axis');
  const [first, setFirst] = useState('1');
  const [count, setCount] = useState('5');
  const found = seedsFrom(first, count);
  const seeds = typeof found === 'string' ? [] : found;
  return (
    <>
      <Text size="sm">{t('tries.seedsHelp')}</Text>
      <TryForm
        values={seeds}
        problem={typeof found === 'string' ? found : null}
        onBegin={(seconds) => void beginSeeds(moment, seeds, seconds)}
      >
        <TextInput
          size="xs"
          w={110}
          inputMode="numeric"
          label={t('tries.firstSeed')}
          value={first}
          onChange={({ currentTarget }) => setFirst(currentTarget.value)}
          data-testid="tries-first-seed"
        />
        <TextInput
          size="xs"
          w={130}
          inputMode="numeric"
          label={t('tries.seedCount')}
          value={count}
          onChange={({ currentTarget }) => setCount(currentTarget.value)}
          data-testid="tries-seed-count"
        />
      </TryForm>
    </>
  );
}
