import { TextInput } from '@mantine/core';
import { useEffect, useRef, useState } from 'react';
import { useTranslation } from 'react-i18next';

interface AddPortProps {
  readonly taken: readonly string[];
  readonly onDone: (name: string | null) => void;
}

/** Names a port of an open action or subtree. */
export function AddPort({ taken, onDone }: AddPortProps) {
  const { t } = useTranslation('inspector');
  const field = useRef<HTMLInputElement>(null);
  useEffect(() => {
    field.current?.focus();
  }, []);
  const [name, setName] = useState('');
  const isValid = /^[A-Za-z_][\w.-]*$/.test(name) && !taken.includes(name);
  return (
    <TextInput
      size="xs"
      aria-label={t('portName')}
      placeholder={t('portName')}
      value={name}
      error={name !== '' && !isValid}
      ref={field}
      onChange={(event) => {
        setName(event.currentTarget.value);
      }}
      onBlur={() => {
        onDone(isValid ? name : null);
      }}
      onKeyDown={(event) => {
        if (event.key === 'Enter' && isValid) event.currentTarget.blur();
        if (event.key === 'Escape') onDone(null);
      }}
    />
  );
}
