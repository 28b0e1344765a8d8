import { ActionIcon } from '@mantine/core';
import { IconCursorText } from '@tabler/icons-react';
import { memo } from 'react';
import { useTranslation } from 'react-i18next';
import { keyOf } from '@/model/keys/rename';
import { treeOfScope } from '@/model/keys/runScope';
import { openRenameKey } from '@/store/dialogs/renameKey';
import { useProjectStore } from '@/store/project';
import type { BlackboardRow as Row } from '@/store/session/types';
import classes from './blackboard.module.css';
import { ValueField } from './ValueField';
import { showValue } from './value';

interface BlackboardRowProps {
  readonly row: Row;
  readonly canEdit: boolean;
}

export const BlackboardRow = memo(function BlackboardRow({ row, canEdit }: BlackboardRowProps) {
  const { t } = useTranslation('blackboard');
  const shown = showValue(row.value);
  const tree = useProjectStore((state) => (state.role === 'viewer' ? null : treeOfScope(state, row.scope)));
  return (
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
        {row.type}
      </td>
    </tr>
  );
});

/** Since when a row has its value, and which node wrote it. */
function Written({ t: time, by }: NonNullable<Row['written']>) {
  const { t } = useTranslation('blackboard');
  return (
    <span className={classes['written']} data-testid="written">
      {time === null
        ? t('sinceUnknown')
        : by
          ? t('sinceBy', { time: time.toFixed(2), by })
          : t(by === null ? 'since' : 'sinceOutside', { time: time.toFixed(2) })}
    </span>
  );
}
