import { TextInput } from '@mantine/core';
import { useEffect, useRef, useState } from 'react';
import { useTranslation } from 'react-i18next';
import { canBePort } from '@/model/ports';
import { useUnsaved } from '@/store/saving/useUnsaved';

interface PortNameInputProps {
  /** The current name; empty for a new port. */
  readonly before?: string;
  readonly taken: readonly string[];
  /** Called with the name, or with null if it did not change; `byKey` is true after Enter. */
  readonly onDone: (name: string | null, byKey: boolean) => void;
}

/** A field for the name of a port of an open action or SubTree. */
export function PortNameInput({ before = '', taken, onDone }: PortNameInputProps) {
  const { t } = useTranslation('inspector');
  const field = useRef<HTMLInputElement>(null);
  useEffect(() => {
    field.current?.focus();
    field.current?.select();
    field.current?.scrollIntoView({ block: 'nearest' });
  }, []);
  const [name, setName] = useState(before);
  useUnsaved(name !== before);
  const isDone = useRef(false);
  const byKey = useRef(false);
  const finish = (result: string | null) => {
    if (!isDone.current) onDone(result, byKey.current);
    isDone.current = true;
  };
  const isTaken = name !== before && taken.includes(name);
  const isValid = canBePort(name) && !isTaken;
  const problem = isTaken ? t('portNameTaken') : t('portNameBad');
  return (
    <TextInput
      size="xs"
      flex={1}
      aria-label={t('portName')}
      placeholder={t('portName')}
      value={name}
      error={name === '' || isValid ? null : problem}
      ref={field}
      onChange={(event) => {
        setName(event.currentTarget.value);
      }}
      onBlur={() => {
        finish(isValid && name !== before ? name : null);
      }}
      onKeyDown={(event) => {
        if (event.key === 'Enter' && isValid) {
          byKey.current = true;
          event.currentTarget.blur();
        }
        if (event.key !== 'Escape') return;
        // The key must only leave this field, not the panel.
        event.preventDefault();
        finish(null);
      }}
    />
  );
}
