import { Select } from '@mantine/core';
import { useEffect, useRef } from 'react';
import { useTranslation } from 'react-i18next';
import { fieldLabel, type InterfaceField } from '@/model/rosFields';

interface FieldPickerProps {
  readonly fields: readonly InterfaceField[];
  /** The ports that the block has. */
  readonly taken: readonly string[];
  /** Called with the chosen field, or with null if none was chosen. */
  readonly onDone: (field: InterfaceField | null) => void;
}

/** The list of an interface's fields, from which one is added to the block as a port. */
export function FieldPicker({ fields, taken, onDone }: FieldPickerProps) {
  const { t } = useTranslation('inspector');
  const input = useRef<HTMLInputElement>(null);
  const isDone = useRef(false);
  useEffect(() => {
    input.current?.focus();
    input.current?.scrollIntoView({ block: 'nearest' });
  }, []);
  const finish = (field: InterfaceField | null) => {
    if (!isDone.current) onDone(field);
    isDone.current = true;
  };
  const free = fields.filter(({ port }) => !taken.includes(port));
  return (
    <Select
      size="xs"
      ref={input}
      searchable
      aria-label={t('field')}
      placeholder={t('fieldSearch')}
      data-testid="field-picker"
      nothingFoundMessage={t('noField')}
      maxDropdownHeight={280}
      defaultDropdownOpened
      value={null}
      data={free.map((field) => ({ value: field.port, label: `${fieldLabel(field.port)} · ${field.ros}` }))}
      onChange={(port) => {
        finish(free.find((each) => each.port === port) ?? null);
      }}
      onBlur={() => {
        finish(null);
      }}
      onKeyDown={(event) => {
        if (event.key !== 'Escape') return;
        // The key must only leave this field, not the panel.
        event.preventDefault();
        finish(null);
      }}
    />
  );
}
