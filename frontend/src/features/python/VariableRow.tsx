import { ActionIcon } from '@mantine/core';
import { IconChevronDown, IconChevronRight, IconPencil } from '@tabler/icons-react';
import { useEffect, useState } from 'react';
import { useTranslation } from 'react-i18next';
import { partsOf, setVariable, type Variable } from '@/store/python/stop';
import classes from './python.module.css';

interface VariableRowProps {
  readonly variable: Variable;
  /** Where the variable is a part of, to set it; 0 if it cannot be set. */
  readonly owner?: number;
  readonly isOpen?: boolean;
}

/** A value with its parts, which are asked for when it is opened. */
export function VariableRow({ variable, owner = 0, isOpen: isOpenFirst = false }: VariableRowProps) {
  const { t } = useTranslation('debug');
  const [isOpen, setOpen] = useState(isOpenFirst);
  const [isEdited, setEdited] = useState(false);
  const { name, value, type, reference } = variable;
  return (
    <li className={classes['variable']}>
      <div className={classes['line']}>
        {reference > 0 ? (
          <ActionIcon
            size={24}
            aria-label={t('python.parts', { name })}
            aria-expanded={isOpen}
            onClick={() => setOpen(!isOpen)}
          >
            {isOpen ? <IconChevronDown size={15} /> : <IconChevronRight size={15} />}
          </ActionIcon>
        ) : (
          <span className={classes['leaf']} />
        )}
        <span className={classes['name']}>{name}</span>
        {isEdited ? (
          <NewValue
            name={name}
            value={value}
            onDone={(next) => {
              setEdited(false);
              if (next !== null && next !== value) void setVariable(owner, name, next);
            }}
          />
        ) : (
          value && (
            <code className={classes['value']} title={type} data-testid={`value-${name}`}>
              {value}
            </code>
          )
        )}
        {owner > 0 && !isEdited && (
          <ActionIcon
            size={24}
            className={classes['edit'] ?? ''}
            aria-label={t('python.set', { name })}
            onClick={() => setEdited(true)}
          >
            <IconPencil size={14} />
          </ActionIcon>
        )}
      </div>
      {isOpen && <Parts reference={reference} />}
    </li>
  );
}

/** The parts of a value. */
function Parts({ reference }: { readonly reference: number }) {
  const { t } = useTranslation('debug');
  const [parts, setParts] = useState<readonly Variable[] | null>(null);
  const [refusal, setRefusal] = useState('');
  useEffect(() => {
    let isGone = false;
    partsOf(reference).then(
      (found) => isGone || setParts(found),
      (error: Error) => isGone || setRefusal(error.message),
    );
    return () => {
      isGone = true;
    };
  }, [reference]);
  if (refusal) return <p className={classes['note']}>{refusal}</p>;
  if (parts?.length === 0) return <p className={classes['note']}>{t('python.noParts')}</p>;
  return (
    <ul className={classes['parts']}>
      {parts?.map((each) => (
        <VariableRow key={each.name} variable={each} owner={reference} />
      ))}
    </ul>
  );
}

interface NewValueProps {
  readonly name: string;
  readonly value: string;
  readonly onDone: (value: string | null) => void;
}

function NewValue({ name, value, onDone }: NewValueProps) {
  const { t } = useTranslation('debug');
  const [text, setText] = useState(value);
  return (
    <input
      // eslint-disable-next-line jsx-a11y/no-autofocus -- the user has just asked for this field
      autoFocus
      className={classes['field']}
      aria-label={t('python.newValue', { name })}
      value={text}
      onChange={({ currentTarget }) => setText(currentTarget.value)}
      onBlur={() => onDone(null)}
      onKeyDown={({ key }) => {
        if (key === 'Enter') onDone(text);
        if (key === 'Escape') onDone(null);
      }}
    />
  );
}
