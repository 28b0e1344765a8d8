import { Autocomplete } from '@mantine/core';
import { useTranslation } from 'react-i18next';

interface TypeInputProps {
  readonly name: string;
  readonly labelledBy: string;
  readonly value: string;
  /** The interfaces that are installed here; others can be typed. */
  readonly types: readonly string[];
  readonly error: boolean;
  readonly onChange: (value: string) => void;
}

/** The field for the type of a ROS action, service or message, with the list of those that are installed. */
export function TypeInput({ name, labelledBy, value, types, error, onChange }: TypeInputProps) {
  const { t } = useTranslation('inspector');
  return (
    <Autocomplete
      size="xs"
      aria-labelledby={labelledBy}
      data-testid={`port-${name}`}
      styles={{ input: { fontFamily: 'var(--bts-font-mono)' } }}
      placeholder={t('typeSearch')}
      spellCheck={false}
      data={[...types]}
      limit={60}
      maxDropdownHeight={280}
      value={value}
      error={error}
      onChange={onChange}
    />
  );
}
