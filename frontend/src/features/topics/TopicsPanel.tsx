import { Button, SegmentedControl } from '@mantine/core';
import { IconPlugConnected, IconSend } from '@tabler/icons-react';
import { Suspense, useEffect, useRef, useState } from 'react';
import { useTranslation } from 'react-i18next';
import { followPastTopics } from '@/store/moment/pastTopics';
import { useIsBack } from '@/store/moment/store';
import { perform } from '@/commands/registry';
import { refreshTopics } from '@/store/run/topics';
import { useSessionStore } from '@/store/session/store';
import { useTopicsStore } from '@/store/session/topics';
import { useVisible } from '@/ui/hooks/useVisible';
import { lazyPart } from '@/ui/parts';
import { EchoList } from './EchoList';
import { LaunchNodes } from './LaunchNodes';
import { openPublish } from './publishing';
import { TopicList } from './TopicList';
import classes from './topics.module.css';

const Plot = lazyPart(async () => (await import('./Plot')).Plot);

const REFRESH_MS = 1000;

/** The panel of the session's ROS graph: topics with their messages, and the project's launch nodes. */
export function TopicsPanel() {
  const { t } = useTranslation('topics');
  const panel = useRef<HTMLElement>(null);
  const isVisible = useVisible(panel);
  const isUp = useIsUp();
  const nodes = useSessionStore((state) => state.launchNodes);
  const isViewer = useSessionStore((state) => state.introspection?.role === 'viewer');
  const hasPlots = useTopicsStore((state) => state.plotted.length > 0);
  const hasEchoes = useTopicsStore((state) => Object.keys(state.echoes).length > 0);
  const [shown, setShown] = useState<'topics' | 'nodes'>('topics');

  const isBack = useIsBack();
  useEffect(() => (isVisible && isBack ? followPastTopics() : undefined), [isVisible, isBack]);
  useEffect(() => {
    if (!isVisible || !isUp || isBack || shown !== 'topics') return;
    void refreshTopics();
    const timer = setInterval(() => void refreshTopics(), REFRESH_MS);
    return () => clearInterval(timer);
  }, [isVisible, isUp, isBack, shown]);

  const failed = nodes.filter((node) => node.state === 'failed').length;
  return (
    <section ref={panel} className={classes['panel']} data-testid="topics" aria-label={t('label')}>
      <div className={classes['bar']}>
        <SegmentedControl
          size="xs"
          value={shown}
          aria-label={t('label')}
          data={[
            { value: 'topics', label: t('topics') },
            {
              value: 'nodes',
              label: nodes.length > 0 ? t('nodesCount', { count: nodes.length }) : t('nodes'),
            },
          ]}
          onChange={(value) => setShown(value as typeof shown)}
        />
        {failed > 0 ? <span className={classes['failed']}>{t('nodesFailed', { count: failed })}</span> : null}
        <span className={classes['spacer']} />
        <Button
          size="compact-sm"
          variant="default"
          leftSection={<IconSend size={14} />}
          disabled={!isUp || isViewer || isBack}
          onClick={() => openPublish('', '')}
        >
          {t('publish')}
        </Button>
        <Button
          size="compact-sm"
          variant="default"
          leftSection={<IconPlugConnected size={14} />}
          onClick={() => perform('run.connectRos')}
        >
          {t('connect')}
        </Button>
      </div>
      {shown === 'nodes' ? (
        <LaunchNodes nodes={nodes} />
      ) : isUp || isBack ? (
        <div
          className={classes['split']}
          data-wide={hasEchoes || undefined}
          data-plots={hasPlots || undefined}
        >
          <TopicList />
          {hasEchoes ? (
            <div className={classes['details']}>
              <EchoList />
            </div>
          ) : null}
          {hasPlots ? (
            <div className={classes['details']}>
              <Suspense fallback={<p className={classes['empty']}>{t('loadingPlot')}</p>}>
                <Plot isVisible={isVisible} />
              </Suspense>
            </div>
          ) : null}
        </div>
      ) : (
        <p className={classes['empty']}>{t('off')}</p>
      )}
    </section>
  );
}

const useIsUp = () => useSessionStore(({ executor }) => executor !== 'idle' && executor !== 'connected');
