import { TextInput } from '@mantine/core';
import { notifications } from '@mantine/notifications';
import { memo, useState, type KeyboardEvent } from 'react';
import { useTranslation } from 'react-i18next';
import { send } from '@/store/session/connection';
import type { BlackboardRow as Row } from '@/store/session/types';
import classes from './blackboard.module.css';
import { readValue, showValue } from './value';

interface BlackboardRowProps {
  readonly row: Row;
  readonly canEdit: boolean;
}

export const BlackboardRow = memo(function BlackboardRow({ row, canEdit }: BlackboardRowProps) {
  const { t } = useTranslation('blackboard');
  const shown = showValue(row.value);
  const [draft, setDraft] = useState<string | null>(null);

  const write = () => {
    if (draft === null || draft === shown) return setDraft(null);
    send('set_blackboard', { scope: row.scope, key: row.key, value: readValue(draft, row.type) }).then(
      () => setDraft(null),
      (error: Error) => notifications.show({ color: 'red', title: t('refused'), message: error.message }),
    );
  };
  const onKey = (event: KeyboardEvent) => {
    if (event.key === 'Enter') write();
    if (event.key === 'Escape') setDraft(null);
  };

  return (
    <tr data-testid={`blackboard-${row.key}`}>
      <th scope="row" className={classes['key']} title={row.key}>
        {row.key}
      </th>
      <td>
        {canEdit ? (
          <TextInput
            size="xs"
            value={draft ?? shown}
            aria-label={t('valueOf', { key: row.key })}
            onChange={(event) => setDraft(event.currentTarget.value)}
            onBlur={write}
            onKeyDown={onKey}
          />
        ) : (
          // A new key restarts the animation at each change.
          <span key={row.changedAt} className={classes['value']} title={shown}>
            {shown}
          </span>
        )}
      </td>
      <td className={classes['type']} title={row.type}>
        {row.type}
      </td>
    </tr>
  );
});
