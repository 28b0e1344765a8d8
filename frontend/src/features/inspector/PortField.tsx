import { ActionIcon, Tooltip } from '@mantine/core';
import { IconArrowBackUp, IconBraces, IconTrash } from '@tabler/icons-react';
import { useId } from 'react';
import { useTranslation } from 'react-i18next';
import { readPortText, type PortSpec } from '@/model/ports';
import { KeyInput } from './KeyInput';
import { ValueInput } from './ValueInput';
import classes from './Inspector.module.css';

interface PortFieldProps {
  readonly port: PortSpec;
  /** null: nothing is set. */
  readonly value: string | null;
  readonly keys: readonly string[];
  readonly error: string | null;
  /** Set on the node without being declared: it can be taken away. */
  readonly isExtra: boolean;
  readonly onChange: (value: string | null) => void;
}

/** One port: its value or its blackboard key, with the widget that its type asks for. */
export function PortField({ port, value, keys, error, isExtra, onChange }: PortFieldProps) {
  const { t } = useTranslation('inspector');
  const label = useId();
  const kind = value === null ? 'empty' : readPortText(value).kind;
  const isKey =
    kind === 'key' ||
    kind === 'same-name' ||
    kind === 'broken' ||
    (port.direction === 'output' && kind !== 'literal');
  return (
    <div className={classes['portField']}>
      <div className={classes['portHead']}>
        <span className={classes['portLabel']} id={label}>
          {port.name}
        </span>
        <span className={classes['portType']}>
          {port.type !== 'any' && port.type}
          {port.direction !== 'input' && !isExtra && ` · ${t(`directions.${port.direction}`)}`}
          {port.required && ` · ${t('required')}`}
        </span>
        <span className={classes['spacer']} />
        {port.direction !== 'output' && (
          <Tooltip label={t(isKey ? 'toLiteral' : 'toKey')}>
            <ActionIcon
              size={20}
              aria-label={t(isKey ? 'toLiteral' : 'toKey')}
              aria-pressed={isKey}
              onClick={() => {
                onChange(isKey ? (port.default ?? '') : `{${port.name}}`);
              }}
            >
              <IconBraces size={14} aria-hidden="true" />
            </ActionIcon>
          </Tooltip>
        )}
        {isExtra && (
          <ActionIcon
            size={20}
            aria-label={t('remove', { name: port.name })}
            onClick={() => {
              onChange(null);
            }}
          >
            <IconTrash size={14} aria-hidden="true" />
          </ActionIcon>
        )}
        {!isExtra && value !== null && !port.required && (
          <Tooltip label={t('reset')}>
            <ActionIcon
              size={20}
              aria-label={t('reset')}
              onClick={() => {
                onChange(null);
              }}
            >
              <IconArrowBackUp size={14} aria-hidden="true" />
            </ActionIcon>
          </Tooltip>
        )}
      </div>
      {isKey ? (
        <KeyInput
          name={port.name}
          labelledBy={label}
          value={value ?? ''}
          keys={keys}
          error={error}
          onChange={onChange}
        />
      ) : (
        <ValueInput
          keys={keys}
          port={port}
          labelledBy={label}
          value={value}
          error={error}
          onChange={onChange}
        />
      )}
      {port.description && <p className={classes['portDoc']}>{port.description}</p>}
    </div>
  );
}
