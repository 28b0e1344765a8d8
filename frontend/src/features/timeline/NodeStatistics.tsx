import { useEffect, useState } from 'react';
import { useTranslation } from 'react-i18next';
import type { NodeStatus } from '@/generated/messages';
import { trace } from '@/store/session/trace/trace';
import { BIT } from '@/store/session/trace/nodeTrace';
import { useSessionStore } from '@/store/session/store';
import classes from './timeline.module.css';

const EVERY_MS = 500;

interface NodeStatisticsProps {
  readonly tree: string;
  readonly node: string;
}

interface Statistics {
  status: NodeStatus;
  runs: number;
  seconds: number;
  successes: number;
  failures: number;
}

/** The statistics of a block in this run: over all its instances, within the range of the timeline. */
export function NodeStatistics({ tree, node }: NodeStatisticsProps) {
  const { t } = useTranslation(['timeline', 'run']);
  const nodes = useSessionStore((state) => state.tree);
  const [shown, setShown] = useState<Statistics | null>(null);
  useEffect(() => {
    const uids = nodes.filter((n) => n.tree_id === tree && n.node_id === node).map((n) => n.uid);
    const update = () => setShown(uids.length > 0 ? statisticsOf(uids) : null);
    update();
    const timer = setInterval(update, EVERY_MS);
    return () => clearInterval(timer);
  }, [nodes, tree, node]);
  if (!shown) return null;
  const rows = [
    ['status', t(`run:status.${shown.status}`)],
    ['runs', String(shown.runs)],
    ['mean', shown.runs > 0 ? `${(shown.seconds / shown.runs).toFixed(2)} s` : '—'],
    ['successes', String(shown.successes)],
    ['failures', String(shown.failures)],
  ] as const;
  return (
    <section className={classes['statistics']} aria-label={t('node.title')} data-testid="node-statistics">
      <h2 className={classes['statisticsTitle']}>{t('node.title')}</h2>
      <dl className={classes['statisticsList']}>
        {rows.map(([key, value]) => (
          <div key={key} data-key={key}>
            <dt>{t(`node.${key}`)}</dt>
            <dd>{value}</dd>
          </div>
        ))}
      </dl>
    </section>
  );
}

function statisticsOf(uids: readonly number[]): Statistics {
  const sum: Statistics = { status: 'IDLE', runs: 0, seconds: 0, successes: 0, failures: 0 };
  for (const uid of uids) {
    const status = trace.status(uid);
    if (status !== 'IDLE') sum.status = status;
    for (const { start, end, mask } of trace.stretches(uid, trace.begin, trace.now)) {
      if (mask & BIT.RUNNING) {
        sum.runs += 1;
        sum.seconds += end - start;
      }
      if (mask & BIT.SUCCESS) sum.successes += 1;
      if (mask & BIT.FAILURE) sum.failures += 1;
    }
  }
  return sum;
}
