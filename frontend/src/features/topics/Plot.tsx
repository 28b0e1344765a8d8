import { ActionIcon, CloseButton, Tooltip, useComputedColorScheme } from '@mantine/core';
import { IconPlayerPause, IconPlayerPlay } from '@tabler/icons-react';
import { useEffect, useRef, useState } from 'react';
import { useTranslation } from 'react-i18next';
import uPlot from 'uplot';
import 'uplot/dist/uPlot.min.css';
import { clearPlots, togglePlot, useTopicsStore } from '@/store/session/topics';
import { colorOf, dataOf, HEIGHT_PX, optionsFor } from './chart';
import classes from './topics.module.css';

const REDRAW_MS = 100;

interface PlotProps {
  readonly isVisible: boolean;
}

/** The chosen fields over simulated time; a drag zooms, a double click shows everything again. */
export function Plot({ isVisible }: PlotProps) {
  const { t } = useTranslation('topics');
  const plotted = useTopicsStore((state) => state.plotted);
  const isDark = useComputedColorScheme('light', { getInitialValueInEffect: false }) === 'dark';
  const host = useRef<HTMLDivElement>(null);
  const [isHeld, setHeld] = useState(false);
  const held = useRef(isHeld);
  useEffect(() => {
    held.current = isHeld;
  }, [isHeld]);

  useEffect(() => {
    const element = host.current;
    if (!element || !isVisible) return;
    const chart = new uPlot(optionsFor(plotted, element), dataOf(plotted), element);
    let version = -1;
    const timer = setInterval(() => {
      const { plotVersion } = useTopicsStore.getState();
      if (held.current || plotVersion === version) return;
      version = plotVersion;
      chart.setData(dataOf(plotted));
    }, REDRAW_MS);
    const resized = new ResizeObserver(() => {
      if (element.clientWidth > 0) chart.setSize({ width: element.clientWidth, height: HEIGHT_PX });
    });
    resized.observe(element);
    return () => {
      clearInterval(timer);
      resized.disconnect();
      chart.destroy();
    };
    // The colours of the axes depend on the theme.
  }, [plotted, isVisible, isDark]);

  return (
    <section className={classes['plot']} aria-label={t('plotLabel')} data-testid="plot">
      <div className={classes['plotHead']}>
        {plotted.map(({ topic, path }, index) => (
          <button
            key={`${topic} ${path}`}
            type="button"
            className={classes['series']}
            title={t('unplot')}
            aria-label={t('unplotOf', { path: `${topic}.${path}` })}
            onClick={() => togglePlot(topic, path)}
          >
            <span className={classes['seriesMark']} style={{ background: colorOf(index) }} />
            {topic}.{path}
          </button>
        ))}
        <span className={classes['spacer']} />
        <Tooltip label={t(isHeld ? 'resume' : 'hold')}>
          <ActionIcon size="sm" aria-label={t(isHeld ? 'resume' : 'hold')} onClick={() => setHeld(!isHeld)}>
            {isHeld ? <IconPlayerPlay size={14} /> : <IconPlayerPause size={14} />}
          </ActionIcon>
        </Tooltip>
        <CloseButton size="sm" aria-label={t('closePlot')} onClick={clearPlots} />
      </div>
      <div ref={host} className={classes['chart']} role="img" aria-label={t('plotLabel')} />
    </section>
  );
}
