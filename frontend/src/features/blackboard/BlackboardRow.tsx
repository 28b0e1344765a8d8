import { ActionIcon } from '@mantine/core';
import { IconCursorText, IconHistory } from '@tabler/icons-react';
import { memo, useState } from 'react';
import { useTranslation } from 'react-i18next';
import { typeName } from '@/i18n/typeWords';
import { keyOf } from '@/model/keys/rename';
import { treeOfScope } from '@/model/keys/runScope';
import { openRenameKey } from '@/store/dialogs/renameKey';
import { useProjectStore } from '@/store/project';
import { lookAt } from '@/store/moment/looking';
import type { BlackboardRow as Row } from '@/store/session/types';
import classes from './blackboard.module.css';
import { Writes } from './Writes';
import { ValueField } from './ValueField';
import { showValue } from './value';

interface BlackboardRowProps {
  readonly row: Row;
  readonly canEdit: boolean;
  /** Whether the writes of the key were recorded. */
  readonly isRecorded: boolean;
}

export const BlackboardRow = memo(function BlackboardRow({ row, canEdit, isRecorded }: BlackboardRowProps) {
  const { t } = useTranslation('blackboard');
  const shown = showValue(row.value);
  const [isOpen, setOpen] = useState(false);
  const history = t(isOpen ? 'history.hide' : 'history.show', { key: row.key });
  const tree = useProjectStore((state) => (state.role === 'viewer' ? null : treeOfScope(state, row.scope)));
  return (
    <>
      <tr data-testid={`blackboard-${row.key}`}>
        <th scope="row" className={classes['key']} title={row.key}>
          <span className={classes['name']}>
            {row.key}
            {tree === null ? null : (
              <ActionIcon
                size={24}
                className={classes['rename'] ?? ''}
                aria-label={t('rename', { key: row.key })}
                title={t('rename', { key: row.key })}
                onClick={() => openRenameKey(keyOf(tree, row.key))}
              >
                <IconCursorText size={14} aria-hidden="true" />
              </ActionIcon>
            )}
            {isRecorded ? (
              <ActionIcon
                size={24}
                className={classes['rename'] ?? ''}
                data-open={isOpen || undefined}
                data-testid={`history-${row.key}`}
                aria-expanded={isOpen}
                aria-label={history}
                title={history}
                onClick={() => setOpen(!isOpen)}
              >
                <IconHistory size={14} aria-hidden="true" />
              </ActionIcon>
            ) : null}
          </span>
        </th>
        <td>
          {canEdit ? (
            <ValueField row={row} />
          ) : (
            // A new key restarts the animation at each change.
            <span key={row.changedAt} className={classes['value']} title={shown}>
              {shown}
            </span>
          )}
          {row.written ? <Written {...row.written} /> : null}
        </td>
        <td className={classes['type']} title={row.type}>
          {typeName(row.type)}
        </td>
      </tr>
      {isOpen && isRecorded ? <Writes row={row} /> : null}
    </>
  );
});

/** Since when a row has its value, and which node wrote it. */
function Written({ t: time, by }: NonNullable<Row['written']>) {
  const { t } = useTranslation('blackboard');
  const words =
    time === null
      ? t('sinceUnknown')
      : by
        ? t('sinceBy', { time: time.toFixed(2), by })
        : t(by === null ? 'since' : 'sinceOutside', { time: time.toFixed(2) });
  if (time === null)
    return (
      <span className={classes['written']} data-testid="written">
        {words}
      </span>
    );
  return (
    <button
      type="button"
      className={classes['written']}
      data-testid="written"
      title={t('history.lookAt')}
      onClick={() => lookAt(time)}
    >
      {words}
    </button>
  );
}
