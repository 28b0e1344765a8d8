import { ActionIcon, Tooltip } from '@mantine/core';
import { IconArrowBackUp, IconBraces, IconCursorText, IconPencil, IconTrash } from '@tabler/icons-react';
import { useEffect, useId, useRef, useState } from 'react';
import { useTranslation } from 'react-i18next';
import { typeName } from '@/i18n/typeWords';
import { keyIn } from '@/model/keys/entry';
import { readPortText, type PortSpec } from '@/model/ports';
import { typeLabel } from '@/model/values';
import type { ShownPort } from '@/store/session/values/shown';
import type { PortMark } from '@/store/run/portMarks';
import { LivePort } from './ports/LivePort';
import { useTyping } from './ports/useTyping';
import { KeyInput } from './KeyInput';
import { PortNameInput } from './PortNameInput';
import { ShowValue } from './ports/ShowValue';
import { useKeptCaret } from './ports/useKeptCaret';
import { TypeInput } from './ports/TypeInput';
import { ValueInput } from './ValueInput';
import classes from './Inspector.module.css';

interface PortFieldProps {
  readonly port: PortSpec;
  /** null if no value is set. */
  readonly value: string | null;
  readonly keys: readonly string[];
  readonly error: string | null;
  readonly onChange: (value: string | null) => void;
  /** Whether the port was just added: then its value gets the caret. */
  readonly isNew?: boolean;
  /** The key under which the page remembers whether the block shows the port's live value. */
  readonly shown: ShownPort;
  /** Called when the focus leaves the field. */
  readonly onLeave?: () => void;
  /** Present only for a port that is set but not declared. */
  readonly onRemove?: (() => void) | undefined;
  /** Present only for a port that all blocks of the type share. */
  readonly onRename?: ((name: string) => void) | undefined;
  /** Renames the key in the port's text, wherever this key is the same entry. */
  readonly onRenameKey: (key: string) => void;
  /** The difference between the running program and the saved text. */
  readonly mark?: PortMark | undefined;
  /** Makes the current text count as saved. */
  readonly onKeep?: () => void;
  /** Restores the saved text. */
  readonly onBack?: (saved: string | null) => void;
  /** The installed types, for the port that holds the type of a ROS interface. */
  readonly types?: readonly string[] | undefined;
  /** The text that is shown for the port's name. */
  readonly label?: string | undefined;
  /** The names of the other ports. */
  readonly taken: readonly string[];
}

/** The field of one port: a value or a blackboard key, with the widget for its type. */
export function PortField(props: PortFieldProps) {
  const { port, value, keys, error, onChange, onRemove, onRename, onRenameKey } = props;
  const { taken, isNew = false, onLeave, mark, onKeep, onBack } = props;
  const { t } = useTranslation(['inspector', 'keys']);
  const label = useId();
  const field = useRef<HTMLDivElement>(null);
  const onLeft = useRef(onLeave);
  useEffect(() => {
    onLeft.current = onLeave;
  });
  useEffect(() => {
    const host = field.current;
    if (!isNew || !host) return;
    const input = host.querySelector('input');
    input?.focus();
    input?.select();
    host.scrollIntoView({ block: 'nearest' });
    const left = ({ relatedTarget }: FocusEvent) => {
      if (!(relatedTarget instanceof Node && host.contains(relatedTarget))) onLeft.current?.();
    };
    host.addEventListener('focusout', left);
    return () => {
      host.removeEventListener('focusout', left);
    };
  }, [isNew]);
  const { isTyping, handlers } = useTyping();
  const [isRenaming, setIsRenaming] = useState(false);
  const isExtra = onRemove !== undefined;
  const read = readPortText(value ?? '');
  const { kind } = read;
  const key = read.kind === 'key' ? `${read.global ? '@' : ''}${read.key}` : port.name;
  // An output is written to a key, even while the typed name still lacks braces.
  const isKey = kind === 'key' || kind === 'same-name' || kind === 'broken' || port.direction === 'output';
  const kept = useKeptCaret(field, isKey ? 'key' : 'value');
  return (
    <div ref={field} className={classes['portField']} {...handlers} {...kept}>
      <div className={classes['portHead']}>
        {isRenaming ? (
          <PortNameInput
            before={port.name}
            taken={taken}
            onDone={(name) => {
              setIsRenaming(false);
              if (name !== null) onRename?.(name);
            }}
          />
        ) : (
          <span className={classes['portLabel']} id={label}>
            {props.label ?? port.name}
          </span>
        )}
        <span className={classes['portType']} title={port.type === 'any' ? undefined : typeLabel(port.type)}>
          {port.type !== 'any' && typeName(port.type)}
          {port.direction !== 'input' && !isExtra && ` · ${t(`directions.${port.direction}`)}`}
          {port.required && ` · ${t('required')}`}
        </span>
        <span className={classes['spacer']} />
        {port.direction !== 'output' && (
          <Tooltip label={t(isKey ? 'toLiteral' : 'toKey')}>
            <ActionIcon
              size={24}
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
        {keyIn(value ?? port.default ?? '', port.name) !== null && (
          <ShowValue port={props.shown} name={port.name} />
        )}
        {(kind === 'key' || kind === 'same-name') && (
          <Tooltip label={t('keys:here')}>
            <ActionIcon size={24} aria-label={t('keys:here')} onClick={() => onRenameKey(key)}>
              <IconCursorText size={14} aria-hidden="true" />
            </ActionIcon>
          </Tooltip>
        )}
        {onRename && (
          <Tooltip label={t('renameHint')}>
            <ActionIcon
              size={24}
              aria-label={t('rename', { name: port.name })}
              onClick={() => {
                setIsRenaming(true);
              }}
            >
              <IconPencil size={14} aria-hidden="true" />
            </ActionIcon>
          </Tooltip>
        )}
        {onRemove && (
          <Tooltip label={t(onRename ? 'removeEverywhere' : 'remove', { name: port.name })}>
            <ActionIcon size={24} aria-label={t('remove', { name: port.name })} onClick={onRemove}>
              <IconTrash size={14} aria-hidden="true" />
            </ActionIcon>
          </Tooltip>
        )}
        {!isExtra && value !== null && !port.required && (
          <Tooltip label={t('reset')}>
            <ActionIcon
              size={24}
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
          error={isNew ? null : error}
          onChange={onChange}
        />
      ) : props.types ? (
        <TypeInput
          name={port.name}
          labelledBy={label}
          value={value ?? ''}
          types={props.types}
          error={!isNew && error !== null}
          onChange={onChange}
        />
      ) : (
        <ValueInput
          keys={keys}
          port={port}
          labelledBy={label}
          value={value}
          error={isNew ? null : error}
          onChange={onChange}
        />
      )}
      <LivePort
        port={port}
        mark={mark}
        isTyping={isTyping}
        onKeep={() => {
          field.current?.querySelector('input')?.focus();
          onKeep?.();
        }}
        onBack={(saved) => {
          field.current?.querySelector('input')?.focus();
          onBack?.(saved);
        }}
      />
      {port.description && <p className={classes['portDoc']}>{port.description}</p>}
    </div>
  );
}
