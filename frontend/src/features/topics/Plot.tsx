import { ActionIcon, CloseButton, Tooltip, useComputedColorScheme } from '@mantine/core';
import { IconDownload, IconPlayerPause, IconPlayerPlay, IconZoomReset } from '@tabler/icons-react';
import { useEffect, useRef, useState } from 'react';
import { useTranslation } from 'react-i18next';
import uPlot from 'uplot';
import 'uplot/dist/uPlot.min.css';
import { lookAt } from '@/store/moment/looking';
import { pastRange, pastSamples, usePastTopics, wantRange } from '@/store/moment/pastTopics';
import { useRange } from '@/store/moment/range';
import { useIsBack, useMoment } from '@/store/moment/store';
import { clearPlots, togglePlot, useTopicsStore } from '@/store/session/topics';
import { dataOf, HEIGHT_PX, markOf, optionsFor } from './chart';
import { downloadCsv } from './csv';
import { PlotNotes } from './PlotNotes';
import { gestures } from './plotGestures';
import { unitOf, type TimeRange } from './plotView';
import classes from './topics.module.css';

const REDRAW_MS = 100;

interface PlotProps {
  readonly isVisible: boolean;
}

/**
 * A plot of the chosen fields over simulated time. While one looks back it is drawn from the recording, for the part
 * of the run that the time axis shows, with the moment. The wheel zooms, a drag moves, a double click shows
 * everything, a click goes to its moment.
 */
export function Plot({ isVisible }: PlotProps) {
  const { t } = useTranslation('topics');
  const plotted = useTopicsStore((state) => state.plotted);
  const isBack = useIsBack();
  const isDark = useComputedColorScheme('light', { getInitialValueInEffect: false }) === 'dark';
  const host = useRef<HTMLDivElement>(null);
  const timeLabel = t('timeLabel');
  const shown = useRef<TimeRange | null>(null);
  const showRange = useRef<((range: TimeRange | null) => void) | null>(null);
  const [isZoomed, setZoomed] = useState(false);
  const [isHeld, setHeld] = useState(false);
  const held = useRef(isHeld);
  useEffect(() => {
    held.current = isHeld;
  }, [isHeld]);

  useEffect(() => {
    const element = host.current;
    if (!element || !isVisible) return;
    const chart = new uPlot(optionsFor(plotted, element, timeLabel), [[]], element);
    let version: unknown = null;
    const cursor = document.createElement('div');
    cursor.className = classes['momentCursor'] ?? '';
    cursor.dataset['testid'] = 'plot-cursor';
    chart.over.append(cursor);
    const place = () => {
      const { t: moment } = useMoment.getState();
      const left = moment === null ? -1 : chart.valToPos(moment, 'x');
      cursor.hidden = !(left >= 0 && left <= chart.over.clientWidth);
      cursor.style.left = `${left}px`;
    };
    const draw = () => {
      const range = shown.current ?? (isBack ? pastRange() : null);
      chart.setData(dataOf(plotted, isBack ? pastSamples : undefined), range === null);
      if (range) chart.setScale('x', { ...range });
      element.dataset['samples'] = String(chart.data[0].length);
      place();
    };
    const show = (range: TimeRange | null) => {
      shown.current = range;
      setZoomed(range !== null);
      wantRange(range);
      if (range) chart.setScale('x', { ...range });
      else draw();
      place();
    };
    showRange.current = show;
    draw();
    const endGestures = gestures(chart, element, show, lookAt, () => useMoment.getState().t);
    const stops = [
      useMoment.subscribe((now, before) => {
        if (now.t !== before.t) place();
      }),
      useRange.subscribe((now, before) => {
        if (isBack && now.view !== before.view) draw();
      }),
    ];
    const timer = setInterval(() => {
      const now = isBack ? usePastTopics.getState().series : useTopicsStore.getState().plotVersion;
      if ((held.current && !isBack) || now === version) return;
      version = now;
      draw();
    }, REDRAW_MS);
    const resized = new ResizeObserver(() => {
      if (element.clientWidth > 0) chart.setSize({ width: element.clientWidth, height: HEIGHT_PX });
    });
    resized.observe(element);
    return () => {
      endGestures();
      for (const stop of stops) stop();
      clearInterval(timer);
      resized.disconnect();
      chart.destroy();
    };
    // The colours of the axes depend on the theme.
  }, [plotted, isVisible, isDark, isBack, timeLabel]);

  return (
    <section className={classes['plot']} aria-label={t('plotLabel')} data-testid="plot">
      <div className={classes['plotHead']}>
        {plotted.map(({ topic, path }, index) => (
          <button
            key={`${topic} ${path}`}
            type="button"
            className={classes['series']}
            title={t('unplot')}
            aria-label={t('unplotOf', { path: `${topic}.${path} ${unitOf(path)}`.trim() })}
            onClick={() => togglePlot(topic, path)}
          >
            <span className={classes['seriesMark']} style={markOf(index)} />
            {topic}.{path}
            {unitOf(path) ? <span className={classes['muted']}>{` ${unitOf(path)}`}</span> : null}
          </button>
        ))}
        <span className={classes['spacer']} />
        {isZoomed ? (
          <Tooltip label={t('showAll')}>
            <ActionIcon size={24} aria-label={t('showAll')} onClick={() => showRange.current?.(null)}>
              <IconZoomReset size={15} />
            </ActionIcon>
          </Tooltip>
        ) : null}
        <Tooltip label={t('csv')}>
          <ActionIcon size={24} aria-label={t('csv')} onClick={() => void downloadCsv(plotted)}>
            <IconDownload size={15} />
          </ActionIcon>
        </Tooltip>
        {isBack ? null : (
          <Tooltip label={t(isHeld ? 'resume' : 'holdPlot')}>
            <ActionIcon
              size={24}
              aria-label={t(isHeld ? 'resume' : 'holdPlot')}
              onClick={() => setHeld(!isHeld)}
            >
              {isHeld ? <IconPlayerPlay size={14} /> : <IconPlayerPause size={14} />}
            </ActionIcon>
          </Tooltip>
        )}
        <CloseButton size={24} aria-label={t('closePlot')} onClick={clearPlots} />
      </div>
      {isBack ? <PlotNotes plotted={plotted} /> : null}
      {/* The keys zoom and move the plot, like wheel and drag. */}
      {/* eslint-disable jsx-a11y/no-noninteractive-tabindex */}
      <div
        ref={host}
        className={classes['chart']}
        role="application"
        tabIndex={0}
        aria-label={t('plotKeys')}
        data-testid="chart"
        data-zoomed={isZoomed || undefined}
      />
      {/* eslint-enable jsx-a11y/no-noninteractive-tabindex */}
    </section>
  );
}
