import { memo } from 'react';
import type { BlackboardRow as Row } from '@/store/session/types';
import classes from './blackboard.module.css';
import { ValueField } from './ValueField';
import { showValue } from './value';

interface BlackboardRowProps {
  readonly row: Row;
  readonly canEdit: boolean;
}

export const BlackboardRow = memo(function BlackboardRow({ row, canEdit }: BlackboardRowProps) {
  const shown = showValue(row.value);
  return (
    <tr data-testid={`blackboard-${row.key}`}>
      <th scope="row" className={classes['key']} title={row.key}>
        {row.key}
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
      </td>
      <td className={classes['type']} title={row.type}>
        {row.type}
      </td>
    </tr>
  );
});
