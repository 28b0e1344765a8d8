import { NativeSelect } from '@mantine/core';
import { useMemo } from 'react';
import { useTranslation } from 'react-i18next';
import { lookNow, openRun } from '@/store/moment/looking';
import { useSource } from '@/store/moment/source';
import { runsOf } from '@/store/recording/liveSource';
import { useSessionStore } from '@/store/session/store';
import classes from './axis.module.css';

/** A field that chooses one of the session's runs; the last one is that of the present. */
export function RunSelect({ run }: { readonly run: string }) {
  const { t } = useTranslation('axis');
  const segments = useSessionStore((state) => state.segments);
  const isKept = useSource((state) => state.kept !== null);
  const runs = useMemo(() => runsOf(segments), [segments]);
  if (isKept || runs.length < 2) return null;
  const last = runs.at(-1);
  return (
    <NativeSelect
      size="xs"
      className={classes['run']}
      aria-label={t('run.label')}
      data-testid="axis-run"
      value={run}
      data={runs
        .map((value, at) => ({ value, label: t(value === last ? 'run.last' : 'run.earlier', { n: at + 1 }) }))
        .reverse()}
      onChange={({ currentTarget: { value } }) => (value === last ? lookNow() : openRun(value))}
    />
  );
}
