import { ScrollArea } from '@mantine/core';
import { useMemo } from 'react';
import { useTranslation } from 'react-i18next';
import { useShownSession } from '@/store/moment/session';
import { useExtent } from '@/store/moment/useExtent';
import { useIsBack } from '@/store/moment/store';
import type { BlackboardRow as Row } from '@/store/session/types';
import { BlackboardRow } from './BlackboardRow';
import classes from './blackboard.module.css';

/** The scopes of py_trees, whose keys only its clients can write. */
const READ_ONLY = 'py_trees:';

function byScope(rows: readonly Row[]): [scope: string, rows: Row[]][] {
  const groups = new Map<string, Row[]>();
  const sorted = [...rows].sort((a, b) => a.scope.localeCompare(b.scope) || a.key.localeCompare(b.key));
  for (const row of sorted) groups.set(row.scope, [...(groups.get(row.scope) ?? []), row]);
  return [...groups];
}

/** The blackboard by scope. Changed values flash, and values can be edited while the run is paused. */
export function BlackboardPanel() {
  const { t } = useTranslation('blackboard');
  const blackboard = useShownSession((state) => state.blackboard);
  const isOpen = useShownSession(
    ({ executor, introspection }) =>
      (executor === 'paused' || executor === 'held') && introspection?.role !== 'viewer',
  );
  const isRunning = useShownSession(
    ({ executor, tree }) => ['application_running', 'paused', 'held'].includes(executor) && tree.length > 0,
  );
  const isBack = useIsBack();
  const isRecorded = useExtent() !== null;
  const groups = useMemo(() => byScope(Object.values(blackboard)), [blackboard]);
  return (
    <ScrollArea h="100%" type="auto" data-testid="blackboard">
      {groups.length === 0 ? <p className={classes['empty']}>{t(isRunning ? 'noKeys' : 'empty')}</p> : null}
      {groups.map(([scope, rows]) => (
        <table key={scope} className={classes['table']}>
          <caption className={classes['scope']}>{scope || t('root')}</caption>
          <thead className={classes['head']}>
            <tr>
              <th scope="col">{t('key')}</th>
              <th scope="col">{t('value')}</th>
              <th scope="col">{t('type')}</th>
            </tr>
          </thead>
          <tbody>
            {rows.map((row) => (
              <BlackboardRow
                key={row.key}
                row={row}
                canEdit={isOpen && !isBack && !row.preview && !scope.startsWith(READ_ONLY)}
                isRecorded={isRecorded}
              />
            ))}
          </tbody>
        </table>
      ))}
    </ScrollArea>
  );
}
