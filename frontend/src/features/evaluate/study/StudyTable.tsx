import { Button } from '@mantine/core';
import { useTranslation } from 'react-i18next';
import type { Candidate, Fitness, Study } from '@/model/evaluation/study';
import { percent, short } from '../outcomeText';
import classes from './study.module.css';

interface Props {
  readonly study: Study;
  readonly fits: (candidate: Candidate) => Fitness;
  readonly mayUse: boolean;
  readonly onUse: (candidate: Candidate) => void;
}

const MAIN: readonly Fitness[] = ['fits', 'changed'];

/** The values of today and the best ones, on the same fresh seeds. */
export function StudyTable({ study, fits, mayUse, onUse }: Props) {
  const { t } = useTranslation('evaluate');
  const isRate = study.objective === 'success';
  const rated = (value: number | null): string =>
    value === null ? t('study.undefined') : isRate ? percent(value) : short(value);
  const row = (title: string, each: Candidate, use: boolean) => (
    <tr key={title}>
      <th scope="row">{title}</th>
      <td>
        {use && mayUse && MAIN.includes(fits(each)) ? (
          <Button size="compact-xs" variant="default" onClick={() => onUse(each)}>
            {t('study.use')}
          </Button>
        ) : use ? (
          t(`study.fitness.${fits(each)}`)
        ) : null}
      </td>
      {study.ports.map(({ address }) => (
        <td key={address}>{each.texts[address] || t('study.default')}</td>
      ))}
      <td>{rated(each.rating)}</td>
      <td>{t('study.interval', { ...intervalOf(each), count: each.counted })}</td>
      <td>{each.difference ? difference(each.difference, rated) : ''}</td>
    </tr>
  );
  return (
    // Narrow windows scroll it, also by keys.
    // eslint-disable-next-line jsx-a11y/no-noninteractive-tabindex
    <div className={classes['scroll']} tabIndex={0} role="region" aria-label={t('study.table')}>
      <table className={classes['table']}>
        <thead>
          <tr>
            <td />
            <td />
            {study.ports.map(({ address }) => (
              <th key={address} scope="col">
                {address}
              </th>
            ))}
            <th scope="col">{study.objective}</th>
            <th scope="col">{t('study.success')}</th>
            <th scope="col">{t('study.difference')}</th>
          </tr>
        </thead>
        <tbody>
          {row(t('study.today'), study.today, false)}
          {study.best.map((each, index) => row(t('study.best', { place: index + 1 }), each, true))}
        </tbody>
      </table>
    </div>
  );
}

const intervalOf = ({ rate, low, high }: Candidate) => ({
  rate: percent(rate),
  low: percent(low),
  high: percent(high),
});

function difference(
  [mean, low, high]: readonly [number, number, number],
  rated: (value: number) => string,
): string {
  const signed = (value: number) => `${value > 0 ? '+' : ''}${rated(value)}`;
  return `${signed(mean)} (${signed(low)} … ${signed(high)})`;
}
