import { NativeSelect } from '@mantine/core';
import { useMemo } from 'react';
import { useTranslation } from 'react-i18next';
import { lookNow, openRun } from '@/store/moment/looking';
import { labelOf } from '@/store/moment/compare/runNames';
import { useSource } from '@/store/moment/source';
import { runsOf } from '@/store/recording/liveSource';
import { useSessionStore } from '@/store/session/store';
import classes from '../axis.module.css';

/** A field that chooses one of the session's runs; the last one is that of the present. */
export function RunSelect({ run }: { readonly run: string }) {
  const { t } = useTranslation('axis');
  const segments = useSessionStore((state) => state.segments);
  const isKept = useSource((state) => state.kept !== null);
  const branches = useSessionStore((state) => state.branches);
  const runs = useMemo(() => runsOf(segments), [segments]);
  if (isKept || runs.length < 2) return null;
  const last = runs.at(-1);
  const name = (each: string) => labelOf(each, { segments, branches });
  return (
    <NativeSelect
      size="xs"
      className={classes['run']}
      aria-label={t('run.label')}
      data-testid="axis-run"
      title={name(run)}
      value={run}
      data={runs.map((value) => ({ value, label: name(value) })).reverse()}
      onChange={({ currentTarget: { value } }) => (value === last ? lookNow() : openRun(value))}
    />
  );
}
