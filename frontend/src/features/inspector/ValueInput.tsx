import { SegmentedControl, Select, TextInput } from '@mantine/core';
import type { KeyboardEvent } from 'react';
import { useTranslation } from 'react-i18next';
import { choicesOf, widgetOf, type PortSpec } from '@/model/ports';
import { useFirstPress } from './ports/useFirstPress';
import { ScriptInput } from './ScriptInput';

interface ValueInputProps {
  readonly port: PortSpec;
  readonly labelledBy: string;
  readonly value: string | null;
  /** The blackboard keys of the tree. */
  readonly keys: readonly string[];
  readonly error: string | null;
  readonly onChange: (value: string | null) => void;
}

/** Changes a number by steps of its last written decimal place. */
function stepped(text: string, by: number): string {
  const decimals = /\.(\d+)/.exec(text)?.[1]?.length ?? 0;
  return (Number(text) + by * 10 ** -decimals).toFixed(decimals);
}

const mono = { input: { fontFamily: 'var(--bts-font-mono)' } };

/** The field for a literal value, with the widget for the port's type. */
export function ValueInput({ port, labelledBy, value, keys, error, onChange }: ValueInputProps) {
  const { t } = useTranslation('inspector');
  const selectsAll = useFirstPress();
  const shared = { 'aria-labelledby': labelledBy, 'data-testid': `port-${port.name}`, size: 'xs' } as const;
  const widget = widgetOf(port.type);
  const current = value ?? '';
  const placeholder = port.default === null ? '' : t('default', { value: port.default });

  if (widget === 'boolean') {
    const now = /^(true|1)$/i.test(value ?? port.default ?? '') ? 'true' : 'false';
    return (
      <SegmentedControl
        {...shared}
        value={now}
        onChange={onChange}
        data={[
          { value: 'true', label: t('trueText') },
          { value: 'false', label: t('falseText') },
        ]}
      />
    );
  }
  if (widget === 'enum') {
    return (
      <Select
        {...shared}
        data={[...new Set([...choicesOf(port.type), ...(current === '' ? [] : [current])])]}
        value={value ?? port.default}
        error={error !== null}
        allowDeselect={false}
        onChange={onChange}
      />
    );
  }
  if (widget === 'script') {
    return (
      <ScriptInput
        labelledBy={labelledBy}
        testId={`port-${port.name}`}
        value={current}
        keys={keys}
        onChange={onChange}
      />
    );
  }
  const isNumber = widget === 'number' || widget === 'integer';
  const onKeyDown = (event: KeyboardEvent<HTMLInputElement>): void => {
    const direction = event.key === 'ArrowUp' ? 1 : event.key === 'ArrowDown' ? -1 : 0;
    const text = current === '' ? (port.default ?? '0') : current;
    if (!isNumber || direction === 0 || !Number.isFinite(Number(text))) return;
    event.preventDefault();
    onChange(stepped(text, direction * (event.shiftKey ? 10 : 1)));
  };
  return (
    <TextInput
      {...shared}
      styles={mono}
      value={current}
      placeholder={placeholder}
      error={error !== null}
      spellCheck={false}
      {...(isNumber ? { inputMode: 'decimal' as const, ...selectsAll } : {})}
      onKeyDown={onKeyDown}
      onChange={(event) => {
        const text = event.currentTarget.value;
        // An empty text is a valid value of a text port, but not of a number port.
        onChange(isNumber && text === '' ? null : text);
      }}
    />
  );
}
