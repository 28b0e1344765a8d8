import { Button } from '@mantine/core';
import { useTranslation } from 'react-i18next';
import { release } from '@/store/debug/debugger';
import { useIsBack } from '@/store/moment/store';
import { useSessionStore } from '@/store/session/store';
import { useForcedWords } from './words';
import classes from './debug.module.css';

/** All that is forced on the nodes of the running tree. */
export function ForcedList() {
  const { t } = useTranslation('debug');
  const forced = useSessionStore((state) => state.forced);
  const tree = useSessionStore((state) => state.tree);
  const isDriver = useSessionStore(({ introspection }) => introspection?.role === 'driver');
  const isBack = useIsBack();
  const words = useForcedWords();
  if (!forced || isBack) return null;
  const { alone } = forced;
  const rows = [
    ...(alone ? [{ uid: alone, status: 'RUNNING' as const, once: false, after: false, alone: true }] : []),
    ...forced.nodes.map((node) => ({ ...node, alone: false })),
  ];
  return (
    <section aria-label={t('forced.title')} data-testid="forced-list">
      <h2>{t('forced.title')}</h2>
      <ul className={classes['list']}>
        {rows.map((row) => (
          <li key={`${row.uid} ${row.alone}`} className={classes['line']}>
            <strong title={tree[row.uid - 1]?.path}>{tree[row.uid - 1]?.name}</strong>
            <span className={classes['moment']}>{words(row)}</span>
            {isDriver && (
              <Button size="compact-xs" variant="default" onClick={() => void release([row.uid])}>
                {t('force.release')}
              </Button>
            )}
          </li>
        ))}
      </ul>
    </section>
  );
}
