import { Loader } from '@mantine/core';
import { useTranslation } from 'react-i18next';
import type { Comparison as Compared, Evaluation } from '@/api/evaluations';
import classes from './evaluate.module.css';
import { percent, short } from './outcomeText';
import { refusalText } from '@/i18n/evaluationReasons';
import { useComparison } from './useComparison';

const SIGNIFICANT = 0.05;

interface Props {
  readonly projectId: string;
  readonly evaluation: Evaluation;
  readonly mayReplay: boolean;
  /** Shows the run of a seed whose outcome changed. */
  readonly onChoose: (seed: number) => void;
}

/** What changed since the older revision, in plain words, and the seeds whose outcome changed. */
export function Comparison({ projectId, evaluation, mayReplay, onChoose }: Props) {
  const { t } = useTranslation('evaluate');
  const found = useComparison(projectId, evaluation);
  if (found.isPending) return <Loader size={14} role="status" aria-label={t('compare.reading')} />;
  if (found.isError) return <p role="alert">{refusalText(t, found.error)}</p>;
  const { data } = found;
  return (
    <div data-testid="evaluation-comparison" className={classes['comparison']}>
      <p>{sentence(t, data, evaluation)}</p>
      <Seeds label={t('compare.worse')} seeds={data.only_older} mayReplay={mayReplay} onChoose={onChoose} />
      <Seeds label={t('compare.better')} seeds={data.only_newer} mayReplay={mayReplay} onChoose={onChoose} />
      {data.only_older.length + data.only_newer.length === 0 ? (
        <p className={classes['muted']}>{t('compare.same', { count: data.both + data.neither })}</p>
      ) : null}
      {data.measures.length > 0 ? (
        <ul className={classes['plain']}>
          {data.measures.map(({ name, difference: [mean = 0, low = 0, high = 0] }) => (
            <li key={name}>
              {t('compare.measure', { name, mean: signed(mean), low: signed(low), high: signed(high) })}
            </li>
          ))}
          <li className={classes['muted']}>{t('compare.notCorrected')}</li>
        </ul>
      ) : null}
    </div>
  );
}

const signed = (value: number): string => `${value > 0 ? '+' : ''}${short(value)}`;
const signedPercent = (value: number): string => `${value > 0 ? '+' : ''}${percent(value)}`;

function sentence(
  t: ReturnType<typeof useTranslation<'evaluate'>>['t'],
  { difference: [value = 0, low = 0, high = 0], p }: Compared,
  { revision, older }: Evaluation,
): string {
  const verdict =
    p >= SIGNIFICANT ? 'compare.noDifference' : value > 0 ? 'compare.isBetter' : 'compare.isWorse';
  const facts = { newer: revision, older, low: signedPercent(low), high: signedPercent(high) };
  return `${t(verdict, facts)} ${t('compare.rates', { ...facts, value: signedPercent(value), p: short(p) })}`;
}

function Seeds({
  label,
  seeds,
  mayReplay,
  onChoose,
}: {
  readonly label: string;
  readonly seeds: readonly number[];
  readonly mayReplay: boolean;
  readonly onChoose: (seed: number) => void;
}) {
  const { t } = useTranslation('evaluate');
  if (seeds.length === 0) return null;
  return (
    <div className={classes['seeds']}>
      <span>{label}</span>
      {seeds.slice(0, 200).map((seed) => (
        <button
          key={seed}
          type="button"
          title={mayReplay ? t('compare.seed', { seed }) : undefined}
          onClick={() => onChoose(seed)}
        >
          {seed}
        </button>
      ))}
      {seeds.length > 200 ? <span>…</span> : null}
    </div>
  );
}
