import { ColorInput, NumberInput, TextInput } from '@mantine/core';
import { useState, type ReactNode } from 'react';
import { readable } from '@/model/document/readable';
import { rounded } from '@/model/universe/geometry';
import { useUnsaved } from '@/store/saving/useUnsaved';
import { isReadOnly } from './editing';
import classes from './editor3d.module.css';

interface NumberFieldProps {
  readonly label: string;
  readonly value: number;
  readonly unit?: string;
  /** Whether the unit is degrees or degrees per second: then three digits are shown. */
  readonly isAngle?: boolean;
  readonly min?: number;
  readonly max?: number;
  readonly step?: number;
  readonly testId?: string;
  readonly onCommit: (value: number) => void;
}

/**
 * A number field; the value is applied when the field loses the focus, on Enter, and when the arrows step it.
 */
export function NumberField({
  label,
  value,
  unit,
  isAngle = false,
  min,
  max,
  step = 0.1,
  testId,
  onCommit,
}: NumberFieldProps) {
  const shown = readable(value, isAngle ? '°' : '');
  const [draft, setDraft] = useState<{ of: number; text: string | number }>({ of: shown, text: shown });
  const text = draft.of === shown ? draft.text : shown;
  useUnsaved(String(text) !== String(shown));
  const commit = (wish: string | number) => {
    const next = typeof wish === 'number' ? wish : Number.parseFloat(wish);
    if (Number.isFinite(next)) {
      const kept = Math.min(Math.max(next, min ?? -1e4), max ?? 1e4);
      if (rounded(kept) !== shown) return onCommit(rounded(kept));
    }
    setDraft({ of: shown, text: shown });
  };
  return (
    <NumberInput
      size="xs"
      label={label}
      value={text}
      step={step}
      decimalScale={4}
      disabled={isReadOnly()}
      clampBehavior="none"
      suffix={unit ? ` ${unit}` : ''}
      {...(testId ? { 'data-testid': testId } : {})}
      onChange={(wish) => setDraft({ of: shown, text: wish })}
      onBlur={() => commit(text)}
      onKeyDown={(event) => {
        if (event.key === 'Enter') commit(text);
        if (event.key !== 'ArrowUp' && event.key !== 'ArrowDown') return;
        event.preventDefault();
        const now = typeof text === 'number' ? text : Number.parseFloat(text) || 0;
        commit(rounded(now + (event.key === 'ArrowUp' ? step : -step) * (event.shiftKey ? 10 : 1)));
      }}
      hideControls
      withKeyboardEvents={false}
    />
  );
}

interface TextFieldProps {
  readonly label: string;
  readonly value: string;
  readonly testId?: string;
  readonly placeholder?: string;
  /** Returns the reason why the text is invalid; null if it is valid. */
  readonly problem?: (value: string) => string | null;
  readonly onCommit: (value: string) => void;
}

export function TextField({ label, value, testId, placeholder, problem, onCommit }: TextFieldProps) {
  const [draft, setDraft] = useState<{ of: string; text: string }>({ of: value, text: value });
  const text = draft.of === value ? draft.text : value;
  useUnsaved(text !== value);
  const refused = text === value ? null : (problem?.(text) ?? null);
  const commit = () => {
    if (text !== value && !refused) onCommit(text);
    else setDraft({ of: value, text: value });
  };
  return (
    <TextInput
      size="xs"
      label={label}
      value={text}
      error={refused}
      disabled={isReadOnly()}
      {...(placeholder ? { placeholder } : {})}
      {...(testId ? { 'data-testid': testId } : {})}
      onChange={(event) => setDraft({ of: value, text: event.currentTarget.value })}
      onBlur={commit}
      onKeyDown={(event) => {
        if (event.key === 'Enter') commit();
        if (event.key === 'Escape') setDraft({ of: value, text: value });
      }}
    />
  );
}

/**
 * The colours of the picker: first soft ones for walls and furniture, then strong ones that a camera can
 * detect.
 */
const SWATCHES = [
  '#e9e4da',
  '#b8c4cf',
  '#8899aa',
  '#c28a52',
  '#6e4a2f',
  '#3f6fb5',
  '#4f9a6b',
  '#20c020',
  '#d9a441',
  '#e2543c',
  '#7a4fa0',
  '#2b2f36',
];

interface ColorFieldProps {
  readonly label: string;
  readonly value: string;
  readonly onChange: (value: string) => void;
  readonly onEnd: () => void;
}

export function ColorField({ label, value, onChange, onEnd }: ColorFieldProps) {
  // The typed text is an invalid colour until its last digit.
  const [draft, setDraft] = useState<{ of: string; text: string }>({ of: value, text: value });
  const text = draft.of === value ? draft.text : value;
  useUnsaved(text !== value);
  return (
    <ColorInput
      size="xs"
      label={label}
      value={text}
      format={value.length > 7 ? 'hexa' : 'hex'}
      swatches={SWATCHES}
      swatchesPerRow={6}
      disabled={isReadOnly()}
      popoverProps={{ withinPortal: true }}
      eyeDropperButtonProps={{ 'aria-label': label }}
      onChange={(next) => {
        setDraft({ of: value, text: next });
        if (/^#[0-9a-fA-F]{6}([0-9a-fA-F]{2})?$/.test(next)) onChange(next);
      }}
      onChangeEnd={onEnd}
      onBlur={() => {
        setDraft({ of: value, text: value });
        onEnd();
      }}
    />
  );
}

/** A row of two or three fields of one kind. */
export function FieldGroup({
  title,
  columns = 3,
  children,
}: {
  readonly title: string;
  readonly columns?: 1 | 2 | 3;
  readonly children: ReactNode;
}) {
  return (
    <fieldset className={classes['group']} data-columns={columns}>
      <legend>{title}</legend>
      {children}
    </fieldset>
  );
}
