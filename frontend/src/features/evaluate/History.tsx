import { useTranslation } from 'react-i18next';
import type { Evaluation } from '@/api/evaluations';
import { timeAgo } from '@/i18n/timeAgo';
import classes from './evaluate.module.css';
import { percent } from './outcomeText';

interface Props {
  readonly items: readonly Evaluation[];
  readonly shown: string | null;
  readonly onShow: (id: string) => void;
}

/** The last evaluations, each with its revision and rate. */
export function History({ items, shown, onShow }: Props) {
  const { t, i18n } = useTranslation('evaluate');
  return (
    <ul className={classes['history']} aria-label={t('history')}>
      {items.map((item) => {
        const [side] = item.sides;
        return (
          <li key={item.id}>
            <button
              type="button"
              aria-current={item.id === shown}
              className={classes['past']}
              onClick={() => onShow(item.id)}
            >
              <span>
                {item.name}{' '}
                <span className={classes['muted']}>
                  {item.older === null
                    ? t('revision', { revision: item.revision })
                    : t('revisions', { newer: item.revision, older: item.older })}
                </span>
              </span>
              <span className={classes['muted']}>
                {side && side.done > 0 ? `${percent(side.rate)} · ` : ''}
                {item.state === 'done' ? timeAgo(item.created_at, i18n.language) : t(`state.${item.state}`)}
              </span>
            </button>
          </li>
        );
      })}
    </ul>
  );
}
