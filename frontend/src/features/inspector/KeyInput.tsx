import { Autocomplete } from '@mantine/core';
import { IconBraces } from '@tabler/icons-react';
import { useTranslation } from 'react-i18next';

interface KeyInputProps {
  readonly name: string;
  readonly labelledBy: string;
  /** The text of the port, including the braces. */
  readonly value: string;
  readonly keys: readonly string[];
  readonly error: string | null;
  readonly onChange: (value: string) => void;
}

/** A field for a blackboard key, with completion from the keys of the tree. */
export function KeyInput({ name, labelledBy, value, keys, error, onChange }: KeyInputProps) {
  const { t } = useTranslation('inspector');
  return (
    <Autocomplete
      size="xs"
      aria-labelledby={labelledBy}
      data-testid={`port-${name}`}
      placeholder={`{${name}}`}
      leftSection={<IconBraces size={14} aria-label={t('key')} />}
      data={keys.map((key) => `{${key}}`)}
      value={value}
      error={error !== null}
      comboboxProps={{ shadow: 'md' }}
      styles={{ input: { fontFamily: 'var(--bts-font-mono)', color: 'var(--bts-accent)' } }}
      onChange={onChange}
    />
  );
}
