import { Button, CloseButton } from '@mantine/core';
import { useElementSize, useViewportSize } from '@mantine/hooks';
import { useEffect } from 'react';
import { useTranslation } from 'react-i18next';
import { perform } from '@/commands/registry';
import { lessonPath } from '@/model/lesson/find';
import { useProjectStore } from '@/store/project';
import { useEditorStore } from '@/store/project/editor';
import { useHints } from '../hints';
import { usePresentation } from '@/workspace/presentation';
import { endGuide, isGuideNew, startGuide, STEPS, useGuide, type Step } from './guide';
import classes from './guide.module.css';
import { placeBeside } from './place';
import { needOf } from './progress';
import { useProgress } from './useProgress';
import { useTarget } from './useTarget';

/** The panel that a step opens if its place is not visible. */
const PANELS: Partial<Record<Step, 'palette' | 'inspector'>> = { block: 'palette', fill: 'inspector' };

/**
 * Starts the first task by itself, unless the project has a lesson or the user has already built or run
 * something.
 */
function useBeginning(): void {
  const canBegin = useProjectStore(
    ({ role, projectId, files }) =>
      projectId !== null && role !== 'viewer' && lessonPath(Object.keys(files), 'en') === null,
  );
  useEffect(() => {
    const { done } = useHints.getState();
    if (canBegin && isGuideNew() && !done.includes('build') && !done.includes('run')) startGuide();
  }, [canBegin]);
}

/** The guided first task: three notes in the frame, each shown until its step is done. */
export function Guide() {
  useBeginning();
  useProgress();
  const step = useGuide((state) => state.step);
  const isPresenting = usePresentation(({ mode }) => mode !== 'off');
  const isReadOnly = useProjectStore(({ role }) => role === 'viewer');
  const isShown = step !== null && !isPresenting && !isReadOnly;
  return isShown ? <Mark step={step} /> : null;
}

/**
 * Returns the size of a note from the size of its content; before the content is measured, a typical size.
 */
const outer = (width: number, height: number) =>
  width === 0 ? { width: 296, height: 150 } : { width: width + 24, height: height + 20 };

function Mark({ step }: { readonly step: Step }) {
  const { t } = useTranslation('onboarding');
  const target = useTarget(step);
  const need = useProjectStore(needOf);
  const isDragging = useEditorStore(({ dragged }) => dragged !== null);
  const { ref, width, height } = useElementSize<HTMLDivElement>();
  const room = useViewportSize();
  const place = target && placeBeside(target, outer(width, height), room);
  const panel = target?.isFarOff ? PANELS[step] : undefined;
  return (
    <>
      {target && !target.isFarOff && (
        <div
          className={classes['ring']}
          style={{ left: target.left, top: target.top, width: target.width, height: target.height }}
          data-testid="guide-ring"
          aria-hidden="true"
        />
      )}
      <section
        ref={ref}
        className={classes['note']}
        style={place ? { left: place.left, top: place.top } : { right: 8, bottom: 40 }}
        aria-label={t('guide.label')}
        data-testid="guide"
        data-step={step}
        data-side={place?.side}
        data-passive={isDragging || undefined}
      >
        <header className={classes['head']}>
          <span className={classes['count']}>
            {t('guide.step', { index: STEPS.indexOf(step) + 1, count: STEPS.length })}
          </span>
          <CloseButton
            size={24}
            iconSize={15}
            aria-label={t('guide.skip')}
            title={t('guide.skip')}
            onClick={endGuide}
          />
        </header>
        <p className={classes['text']} aria-live="polite">
          {t(step === 'fill' ? `guide.fill.${need}` : `guide.${step}`)}
        </p>
        <p className={classes['keys']}>{t(step === 'fill' ? `guide.keys.${need}` : `guide.keys.${step}`)}</p>
        <div className={classes['buttons']}>
          {panel ? (
            <Button size="compact-xs" variant="light" h={24} onClick={() => perform(`panel.${panel}`)}>
              {t(`guide.open.${panel}`)}
            </Button>
          ) : null}
          <Button size="compact-xs" variant="subtle" color="gray" h={24} onClick={endGuide}>
            {t('guide.skip')}
          </Button>
        </div>
      </section>
    </>
  );
}
