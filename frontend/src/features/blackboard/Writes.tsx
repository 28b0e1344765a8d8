import { useEffect, useState } from 'react';
import { useTranslation } from 'react-i18next';
import { followWrites, lookAt } from '@/store/moment/looking';
import { useMoment } from '@/store/moment/store';
import type { EntryName, WriteAt } from '@/store/recording/types';
import classes from './blackboard.module.css';
import { showValue } from './value';

/** The recorded writes of a key, the last one first; each leads to its moment. */
export function Writes({ row: { scope, key } }: { readonly row: EntryName }) {
  const { t } = useTranslation('blackboard');
  const [writes, setWrites] = useState<readonly WriteAt[] | null>(null);
  const shown = useMoment((state) => state.shown?.t ?? null);
  useEffect(() => followWrites({ scope, key }, setWrites), [scope, key]);
  const current = shown === null ? -1 : (writes?.findIndex(({ t: at }) => at <= shown) ?? -1);
  return (
    <tr>
      <td colSpan={3} className={classes['writes']}>
        {writes === null || writes.length === 0 ? (
          <p className={classes['noWrites']} role="status">
            {t(writes === null ? 'history.reading' : 'history.none')}
          </p>
        ) : (
          <ol aria-label={t('history.label', { key })} data-testid={`writes-${key}`}>
            {writes.map(({ t: at, value, isRemoved, by }, index) => (
              <li key={`${at}/${index}`}>
                <button
                  type="button"
                  className={classes['write']}
                  title={t('history.lookAt')}
                  aria-current={index === current || undefined}
                  data-testid="write"
                  onClick={() => lookAt(at)}
                >
                  <span className={classes['writeTime']}>{at.toFixed(2)} s</span>
                  <span className={classes['writeValue']}>
                    {isRemoved ? t('history.removed') : showValue(value)}
                  </span>
                  <span className={classes['writer']}>{by === '' ? t('history.outside') : by}</span>
                </button>
              </li>
            ))}
          </ol>
        )}
      </td>
    </tr>
  );
}
