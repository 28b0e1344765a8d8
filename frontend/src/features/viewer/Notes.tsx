import { Button, CloseButton } from '@mantine/core';
import { useEffect } from 'react';
import { useTranslation } from 'react-i18next';
import { useIsBack } from '@/store/moment/store';
import { useSessionStore } from '@/store/session/store';
import { perform } from '@/commands/registry';
import { PathsLegend } from './paths/PathsLegend';
import { distances, setMeasuring, useMeasuring } from './measuring';
import { moveBack, useMoves } from './lastMove';
import classes from './viewer.module.css';

/** The messages of the 3D view's tools, above the picture. */
export function Notes() {
  return (
    <div className={classes['notes']}>
      <Measured />
      <Moved />
      <PathsLegend />
    </div>
  );
}

function Measured() {
  const { t } = useTranslation('viewer');
  const { isOn, points } = useMeasuring();
  if (!isOn) return null;
  const [a, b] = points;
  const measured = a && b ? distances([a, b]) : null;
  return (
    <div
      className={classes['note']}
      role="status"
      data-testid="measured"
      data-m={measured?.straight.toFixed(3)}
    >
      {measured
        ? t('measured', { straight: measured.straight.toFixed(2), flat: measured.flat.toFixed(2) })
        : t(a ? 'measureSecond' : 'measureFirst')}
      <CloseButton size="xs" aria-label={t('measureEnd')} onClick={() => setMeasuring(false)} />
    </div>
  );
}

function Moved() {
  const { t } = useTranslation('viewer');
  const last = useMoves((state) => state.last);
  const isBack = useIsBack();
  const canMove = useSessionStore(({ executor }) =>
    ['universe_ready', 'visualization_ready', 'paused'].includes(executor),
  );
  // When time continues, the body's old place is no longer valid.
  useEffect(() => {
    if (!canMove) useMoves.setState({ last: null });
  }, [canMove]);
  if (!last || !canMove || isBack) return null;
  return (
    <div className={classes['note']} role="status" data-testid="moved">
      {t('moved', { body: last.body })}
      <Button size="compact-xs" variant="light" onClick={() => void moveBack().catch(() => undefined)}>
        {t('moveBack')}
      </Button>
      <Button
        size="compact-xs"
        variant="subtle"
        onClick={() => {
          perform('run.resetWorld');
          useMoves.setState({ last: null });
        }}
      >
        {t('resetWorld')}
      </Button>
    </div>
  );
}
