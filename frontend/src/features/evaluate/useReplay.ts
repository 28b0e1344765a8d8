import { notifications } from '@mantine/notifications';
import { useCallback, useEffect, useRef, useState } from 'react';
import { useTranslation } from 'react-i18next';
import { evaluations, type Outcome } from '@/api/evaluations';
import { runs } from '@/api/runs';
import { openKept } from '@/store/moment/looking';
import { storedSource } from '@/store/recording/storedSource';
import { linesText, refusalText } from '@/i18n/evaluationReasons';

const LOOK_MS = 700;

/** Returns the seed that is being run again, a function that plays a run at its decision, and one that cancels. */
export function useReplay(projectId: string, evaluationId: string) {
  const { t } = useTranslation('evaluate');
  const [seed, setSeed] = useState<number | null>(null);
  const current = useRef(0);
  const cancelled = useRef(0);
  const asked = useRef<string | null>(null);
  useEffect(
    () => () => {
      current.current += 1;
    },
    [evaluationId],
  );
  const play = useCallback(
    async (revision: number, { seed: wanted, end_s }: Outcome) => {
      const number = ++current.current;
      const isCurrent = () => number === current.current;
      setSeed(wanted);
      asked.current = null;
      try {
        let replay = await evaluations.askReplay(projectId, evaluationId, revision, wanted);
        if (isCurrent()) asked.current = replay.id;
        else if (cancelled.current === number)
          void evaluations.cancelReplay(projectId, evaluationId, replay.id).catch(() => undefined);
        while (isCurrent() && (replay.state === 'waiting' || replay.state === 'running')) {
          await new Promise((resolve) => setTimeout(resolve, LOOK_MS));
          if (isCurrent()) replay = await evaluations.replay(projectId, evaluationId, replay.id);
        }
        if (!isCurrent()) return;
        if (replay.run === null)
          throw new Error(replay.error ? linesText(t, replay.error) : t('replay.gone'));
        const run = await runs.get(projectId, replay.run);
        if (isCurrent()) openKept(storedSource(projectId, run), run, end_s);
      } catch (error) {
        if (isCurrent())
          notifications.show({
            color: 'red',
            title: t('failed.replay', { seed: wanted }),
            message: refusalText(t, error as Error),
          });
      } finally {
        if (isCurrent()) setSeed(null);
      }
    },
    [projectId, evaluationId, t],
  );
  const cancel = useCallback(async () => {
    cancelled.current = current.current;
    current.current += 1;
    setSeed(null);
    const id = asked.current;
    asked.current = null;
    if (id === null) return;
    try {
      await evaluations.cancelReplay(projectId, evaluationId, id);
    } catch (error) {
      notifications.show({
        color: 'red',
        title: t('failed.cancelReplay'),
        message: refusalText(t, error as Error),
      });
    }
  }, [projectId, evaluationId, t]);
  return { seed, play, cancel };
}
