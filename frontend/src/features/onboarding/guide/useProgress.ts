import { notifications } from '@mantine/notifications';
import { useEffect } from 'react';
import { t } from '@/i18n';
import { useProjectStore } from '@/store/project';
import { useSessionStore } from '@/store/session/store';
import { finishStep, useGuide } from './guide';
import { hasAddedBlock, hasFilled } from './progress';

const isTyping = (): boolean =>
  document.activeElement?.matches('input, textarea, [contenteditable=true]') ?? false;

/** Calls `act` once a text is complete: the user has left the field, or pressed Enter. */
function onceTyped(act: () => void, signal: AbortSignal): void {
  if (!isTyping()) return act();
  const settled = new AbortController();
  const finish = () => {
    settled.abort();
    act();
  };
  const options = { capture: true, signal: AbortSignal.any([settled.signal, signal]) };
  window.addEventListener('focusout', finish, options);
  window.addEventListener('keydown', ({ key }) => key === 'Enter' && finish(), options);
}

/** Continues the first task when the user has done the current step. */
export function useProgress(): void {
  const step = useGuide((state) => state.step);
  useEffect(() => {
    if (step === null) return undefined;
    const ends = new AbortController();
    const unwatch =
      step === 'run'
        ? useSessionStore.subscribe(({ executor }, before) => {
            if (executor !== 'application_running' || before.executor === executor) return;
            if (finishStep('run'))
              notifications.show({
                color: 'green',
                title: t('onboarding:guide.doneTitle'),
                message: t('onboarding:guide.done'),
              });
          })
        : useProjectStore.subscribe((now, before) => {
            if (now.histories === before.histories || now.projectId !== before.projectId) return;
            if (step === 'block' && hasAddedBlock(now, before)) finishStep('block');
            if (step === 'fill' && hasFilled(now, before))
              onceTyped(() => void finishStep('fill'), ends.signal);
          });
    return () => {
      ends.abort();
      unwatch();
    };
  }, [step]);
}
