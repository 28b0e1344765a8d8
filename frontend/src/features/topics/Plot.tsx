import { ActionIcon, CloseButton, Tooltip, useComputedColorScheme } from '@mantine/core';
import { IconPlayerPause, IconPlayerPlay } from '@tabler/icons-react';
import { useEffect, useRef, useState } from 'react';
import { useTranslation } from 'react-i18next';
import uPlot from 'uplot';
import 'uplot/dist/uPlot.min.css';
import { clearPlots, seriesOf, togglePlot, useTopicsStore } from '@/store/session/topics';
import classes from './topics.module.css';

const HEIGHT_PX = 190;
const REDRAW_MS = 100;
/**
 * Colours that can be distinguished on both themes and by colour-blind people (Okabe and Ito), in turn solid
 * and dashed.
 */
const COLORS = ['#0072b2', '#d55e00', '#009e73', '#cc79a7', '#e69f00', '#56b4e9'];

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
        <Tooltip label={t(isHeld ? 'goOn' : 'hold')}>
          <ActionIcon size="sm" aria-label={t(isHeld ? 'goOn' : 'hold')} onClick={() => setHeld(!isHeld)}>
            {isHeld ? <IconPlayerPlay size={14} /> : <IconPlayerPause size={14} />}
          </ActionIcon>
        </Tooltip>
        <CloseButton size="sm" aria-label={t('closePlot')} onClick={clearPlots} />
      </div>
      <div ref={host} className={classes['chart']} role="img" aria-label={t('plotLabel')} />
    </section>
  );
}

const colorOf = (index: number) => COLORS[index % COLORS.length] ?? '#0072b2';

type Plotted = readonly { readonly topic: string; readonly path: string }[];

/** All series over the union of their times, with gaps where a series has no sample. */
function dataOf(plotted: Plotted): uPlot.AlignedData {
  const tables = plotted.map(({ topic, path }): uPlot.AlignedData => {
    const { times, values } = seriesOf(topic, path);
    return [times, values];
  });
  const [first] = tables;
  if (!first) return [[]];
  return tables.length === 1 ? [[...first[0]], [...(first[1] ?? [])]] : uPlot.join(tables);
}

function optionsFor(plotted: Plotted, element: HTMLElement): uPlot.Options {
  const style = getComputedStyle(element);
  const line = style.getPropertyValue('--bts-border').trim();
  const axis: uPlot.Axis = {
    stroke: style.getPropertyValue('--bts-muted').trim(),
    grid: { stroke: line, width: 1 },
    ticks: { stroke: line, width: 1 },
    font: '11px Inter Variable, system-ui, sans-serif',
  };
  return {
    width: Math.max(element.clientWidth, 100),
    height: HEIGHT_PX,
    scales: { x: { time: false } },
    legend: { show: false },
    cursor: { drag: { x: true, y: false } },
    axes: [
      { ...axis, values: (_, ticks) => ticks.map((tick) => `${tick} s`) },
      { ...axis, size: 56 },
    ],
    series: [
      {},
      ...plotted.map(({ topic, path }, index) => ({
        label: `${topic}.${path}`,
        stroke: colorOf(index),
        width: 1.6,
        spanGaps: true,
        points: { show: false },
        ...(Math.floor(index / COLORS.length) % 2 === 1 ? { dash: [6, 4] } : {}),
      })),
    ],
  };
}
