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
  const branches = useSessionStore((state) => state.branches);
  const runs = useMemo(() => runsOf(segments), [segments]);
  if (isKept || runs.length < 2) return null;
  const last = runs.at(-1);
  const label = (value: string, at: number): string => {
    const branch = branches.find((each) => each.run === value);
    const name = branch?.name || t(value === last ? 'run.last' : 'run.earlier', { n: at + 1 });
    const parent = branch ? runs.indexOf(branch.parent) + 1 : 0;
    return branch && parent > 0 ? t('run.branch', { name, parent, t: branch.from_t.toFixed(1) }) : name;
  };
  return (
    <NativeSelect
      size="xs"
      className={classes['run']}
      aria-label={t('run.label')}
      data-testid="axis-run"
      data-branch={branches.some((branch) => branch.run === run) || undefined}
      value={run}
      data={runs.map((value, at) => ({ value, label: label(value, at) })).reverse()}
      onChange={({ currentTarget: { value } }) => (value === last ? lookNow() : openRun(value))}
    />
  );
}
