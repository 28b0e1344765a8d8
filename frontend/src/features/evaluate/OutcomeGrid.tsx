import { useComputedColorScheme } from '@mantine/core';
import { useElementSize } from '@mantine/hooks';
import { useEffect, useRef } from 'react';
import { useTranslation } from 'react-i18next';
import type { Outcome } from '@/api/evaluations';
import { CELL_PX, cellAfter, cellAt, columnsOf, draw, heightOf } from './cells';
import classes from './evaluate.module.css';
import { outcomeText } from './outcomeText';

interface Props {
  readonly first: number;
  readonly cells: number;
  readonly rows: ReadonlyMap<number, Outcome>;
  readonly chosen: number | null;
  readonly marked: ReadonlySet<number>;
  readonly onChoose: (seed: number) => void;
  readonly onPlay: (seed: number) => void;
}

/**
 * One cell a run, drawn on a canvas. It works as a slider over the runs: the arrow keys move, Enter plays, and
 * the text of the cell is the slider's value.
 */
export function OutcomeGrid({ first, cells, rows, chosen, marked, onChoose, onPlay }: Props) {
  const { t } = useTranslation('evaluate');
  const { ref, width } = useElementSize();
  const canvas = useRef<HTMLCanvasElement>(null);
  const scheme = useComputedColorScheme('light', { getInitialValueInEffect: false });
  const columns = columnsOf(width || 280);
  const height = heightOf(cells, columns);
  const index = chosen === null ? null : chosen - first;

  useEffect(() => {
    const element = canvas.current;
    const context = element?.getContext('2d');
    if (!element || !context) return;
    const scale = window.devicePixelRatio || 1;
    const across = columns * CELL_PX;
    element.width = across * scale;
    element.height = height * scale;
    element.style.width = `${across}px`;
    context.setTransform(scale, 0, 0, scale, 0, 0);
    context.clearRect(0, 0, across, height);
    const style = getComputedStyle(element);
    const colors = new Map<string, string>();
    const colorOf = (token: string) => {
      const known = colors.get(token) ?? style.getPropertyValue(token);
      colors.set(token, known);
      return known;
    };
    const outcomeAt = (at: number) => rows.get(first + at);
    draw(
      context,
      { cells, columns, outcomeAt, chosen: index, isMarked: (at) => marked.has(first + at) },
      colorOf,
    );
  }, [cells, columns, height, rows, first, index, marked, scheme]);

  const seed = chosen ?? first;
  return (
    <div ref={ref} className={classes['grid']}>
      <div
        role="slider"
        tabIndex={0}
        className={classes['cells']}
        style={{ height }}
        aria-label={t('grid.label')}
        aria-valuemin={first}
        aria-valuemax={first + Math.max(cells - 1, 0)}
        aria-valuenow={seed}
        aria-valuetext={outcomeText(t, seed, rows.get(seed))}
        data-testid="evaluation-grid"
        onKeyDown={(event) => {
          if (event.key === 'Enter' && rows.has(seed)) {
            event.preventDefault();
            onPlay(seed);
            return;
          }
          const next = cellAfter(event.key, index ?? 0, columns, cells);
          if (next === null) return;
          event.preventDefault();
          onChoose(first + (index === null ? 0 : next));
        }}
        onClick={(event) => {
          const box = event.currentTarget.getBoundingClientRect();
          const at = cellAt(event.clientX - box.left, event.clientY - box.top, columns, cells);
          if (at !== null) onChoose(first + at);
        }}
        onDoubleClick={() => {
          if (chosen !== null && rows.has(chosen)) onPlay(chosen);
        }}
      >
        <canvas ref={canvas} aria-hidden="true" />
      </div>
    </div>
  );
}
