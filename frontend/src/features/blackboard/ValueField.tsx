import { NativeSelect, TextInput } from '@mantine/core';
import { useState, type KeyboardEvent } from 'react';
import { useTranslation } from 'react-i18next';
import { reasonOf } from '@/api/reason';
import { send } from '@/store/session/connection';
import type { BlackboardRow as Row } from '@/store/session/types';
import { readValue, showValue } from './value';

/**
 * The field for an entry's value while time is paused; a refused value stays in the field, with the reason
 * below.
 */
export function ValueField({ row }: { readonly row: Row }) {
  const { t } = useTranslation('blackboard');
  const shown = showValue(row.value);
  const [draft, setDraft] = useState<string | null>(null);
  const [refusal, setRefusal] = useState('');

  const change = (text: string | null) => {
    setDraft(text);
    setRefusal('');
  };
  const write = (text: string | null) => {
    if (text === null || text === shown) return change(null);
    const read = readValue(text, row.type);
    if ('wrong' in read) return setRefusal(t(`wrong.${read.wrong}`, { key: row.key }));
    send('set_blackboard', { scope: row.scope, key: row.key, value: read.value }).then(
      () => change(null),
      (error: Error) => setRefusal(reasonOf(error)),
    );
  };
  const onKey = (event: KeyboardEvent) => {
    if (event.key === 'Enter') write(draft);
    if (event.key === 'Escape') change(null);
  };

  const label = t('valueOf', { key: row.key });
  if (row.type === 'bool')
    return (
      <NativeSelect
        size="xs"
        value={draft ?? shown}
        aria-label={label}
        data={['true', 'false']}
        error={refusal}
        onChange={({ currentTarget }) => {
          change(currentTarget.value);
          write(currentTarget.value);
        }}
      />
    );
  return (
    <TextInput
      size="xs"
      value={draft ?? shown}
      aria-label={label}
      error={refusal}
      onChange={({ currentTarget }) => change(currentTarget.value)}
      onBlur={() => (refusal ? undefined : write(draft))}
      onKeyDown={onKey}
    />
  );
}
