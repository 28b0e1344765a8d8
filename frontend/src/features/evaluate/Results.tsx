import { Alert, Button, Group, SegmentedControl } from '@mantine/core';
import { IconPlayerPlay } from '@tabler/icons-react';
import { useMemo, useState } from 'react';
import { useTranslation } from 'react-i18next';
import type { Evaluation, Outcome } from '@/api/evaluations';
import { LeftOut } from './notes/LeftOut';
import { CoverageButton } from '@/features/behaviourTests/CoverageButton';
import { cellsOf } from './cells';
import { Comparison } from './Comparison';
import classes from './evaluate.module.css';
import { Measures } from './Measures';
import { OutcomeGrid } from './OutcomeGrid';
import { outcomeText } from './outcomeText';
import { RateBar } from './RateBar';
import { linesText, reasonText, refusalText } from '@/i18n/evaluationReasons';
import { useComparison } from './useComparison';
import { useOutcomes } from './useOutcomes';
import { useReplay } from './useReplay';
import { worst } from './worst';

interface Props {
  readonly projectId: string;
  readonly evaluation: Evaluation;
  readonly mayReplay: boolean;
}

/** The results of an evaluation: its rate, a cell for each run, measures, and the worst runs. */
export function Results({ projectId, evaluation, mayReplay }: Props) {
  const { t } = useTranslation('evaluate');
  const [shown, setShown] = useState<number | null>(null);
  const [chosen, setChosen] = useState<number | null>(null);
  const revision = shown !== null && shown === evaluation.older ? shown : evaluation.revision;
  const side = evaluation.sides.find((each) => each.revision === revision);
  const { rows, error } = useOutcomes(projectId, evaluation, revision);
  const compared = useComparison(projectId, evaluation).data;
  const marked = useMemo(
    () => new Set([...(compared?.only_older ?? []), ...(compared?.only_newer ?? [])]),
    [compared],
  );
  const replay = useReplay(projectId, evaluation.id);
  const bad = useMemo(() => worst(rows), [rows]);
  const first = evaluation.seed ?? 0;
  const cells = cellsOf(side?.wanted ?? 0, first, rows.keys());
  const row = chosen === null ? undefined : rows.get(chosen);
  const play = (seed: number) => {
    const found = rows.get(seed);
    if (found && mayReplay) void replay.play(revision, found);
  };
  const stop = () => void replay.cancel();
  const choose = (seed: number) => {
    setChosen(seed);
    play(seed);
  };
  if (!side) return null;
  return (
    <div className={classes['results']}>
      {evaluation.error ? (
        <Alert color="red" title={t('state.failed')} className={classes['error'] ?? ''}>
          <pre>{linesText(t, evaluation.error)}</pre>
        </Alert>
      ) : null}
      <LeftOut notes={evaluation.notes} />
      {evaluation.older !== null ? (
        <SegmentedControl
          size="xs"
          aria-label={t('compare.side')}
          value={String(revision)}
          onChange={(value) => setShown(Number(value))}
          data={evaluation.sides.map((each) => ({
            value: String(each.revision),
            label: t('revision', { revision: each.revision }),
          }))}
        />
      ) : null}
      <RateBar evaluation={evaluation} side={side} />
      {evaluation.older !== null && evaluation.state === 'done' ? (
        <Comparison projectId={projectId} evaluation={evaluation} mayReplay={mayReplay} onChoose={choose} />
      ) : null}
      {side.done > 0 ? <CoverageButton projectId={projectId} evaluation={evaluation} side={side} /> : null}
      {error ? <p role="alert">{refusalText(t, error)}</p> : null}
      {cells > 0 ? (
        <>
          <OutcomeGrid
            first={first}
            cells={cells}
            rows={rows}
            chosen={chosen}
            marked={marked}
            onChoose={setChosen}
            onPlay={play}
          />
          <Group gap="xs" className={classes['cell'] ?? ''}>
            <p role="status" data-testid="evaluation-cell">
              {chosen === null ? t('grid.hint') : outcomeText(t, chosen, row)}
              {row ? <span className={classes['muted']}> {reasonText(t, row.why)}</span> : null}
            </p>
            {row && mayReplay ? (
              <PlayButton row={row} waits={replay.seed === row.seed} onPlay={play} onCancel={stop} />
            ) : null}
          </Group>
        </>
      ) : null}
      {bad.length > 0 ? (
        <section aria-label={t('worst.title')}>
          <h3 className={classes['title']}>{t('worst.title')}</h3>
          <ul className={classes['plain']}>
            {bad.map((each) => (
              <li key={each.seed} className={classes['worst']}>
                <button type="button" className={classes['link']} onClick={() => setChosen(each.seed)}>
                  {outcomeText(t, each.seed, each)}
                </button>
                <span className={classes['muted']}>{reasonText(t, each.why)}</span>
                {mayReplay ? (
                  <PlayButton row={each} waits={replay.seed === each.seed} onPlay={play} onCancel={stop} />
                ) : null}
              </li>
            ))}
          </ul>
        </section>
      ) : null}
      <Measures rows={rows} />
    </div>
  );
}

interface PlayProps {
  readonly row: Outcome;
  readonly waits: boolean;
  readonly onPlay: (seed: number) => void;
  readonly onCancel: () => void;
}

function PlayButton({ row, waits, onPlay, onCancel }: PlayProps) {
  const { t } = useTranslation('evaluate');
  return (
    <>
      <Button
        size="compact-xs"
        variant="light"
        loading={waits}
        leftSection={<IconPlayerPlay size={13} aria-hidden="true" />}
        aria-label={t(waits ? 'replay.waits' : 'replay.playSeed', { seed: row.seed })}
        onClick={() => onPlay(row.seed)}
      >
        {t('replay.play')}
      </Button>
      {waits ? (
        <Button
          size="compact-xs"
          variant="default"
          aria-label={t('replay.cancelSeed', { seed: row.seed })}
          onClick={onCancel}
        >
          {t('replay.cancel')}
        </Button>
      ) : null}
    </>
  );
}
