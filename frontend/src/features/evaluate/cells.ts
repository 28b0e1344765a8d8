import type { Outcome, RunOutcome } from '@/api/evaluations';

/** The side of a cell with its gap, in CSS pixels: a cell is a target of 24 by 24 (WCAG 2.2, 2.5.8). */
export const CELL_PX = 26;
const GAP_PX = 2;

/** The colours of the outcomes; each has a shape of its own too. */
const COLORS: Record<RunOutcome, string> = {
  success: '--bts-success-bright',
  failure: '--bts-failure-bright',
  error: '--bts-failure-bright',
  crashed: '--bts-failure-bright',
  timeout: '--bts-running-bright',
  invalid: '--bts-idle',
  lost: '--bts-idle',
  cancelled: '--bts-idle',
};

/** Returns how many cells a row has. */
export const columnsOf = (width: number): number => Math.max(1, Math.floor(width / CELL_PX));

/** Returns how many cells show all runs: those that are wanted, and those that have an outcome beyond them. */
export function cellsOf(wanted: number, first: number, seeds: Iterable<number>): number {
  let cells = wanted;
  for (const seed of seeds) cells = Math.max(cells, seed - first + 1);
  return cells;
}

/** Returns the height of the grid in CSS pixels. */
export const heightOf = (cells: number, columns: number): number => Math.ceil(cells / columns) * CELL_PX;

/** Returns the index of the cell at a place; null beside all cells. */
export function cellAt(x: number, y: number, columns: number, cells: number): number | null {
  const column = Math.floor(x / CELL_PX);
  const row = Math.floor(y / CELL_PX);
  const index = row * columns + column;
  return column >= 0 && column < columns && row >= 0 && index < cells ? index : null;
}

/** Returns the cell to which a key leads; null for a key that does not move. */
export function cellAfter(key: string, index: number, columns: number, cells: number): number | null {
  const steps: Record<string, number> = {
    ArrowLeft: index - 1,
    ArrowRight: index + 1,
    ArrowUp: index - columns,
    ArrowDown: index + columns,
    PageUp: index - columns * 5,
    PageDown: index + columns * 5,
    Home: 0,
    End: cells - 1,
  };
  const next = steps[key];
  return next === undefined ? null : Math.min(Math.max(next, 0), cells - 1);
}

export interface Drawn {
  readonly cells: number;
  readonly columns: number;
  readonly outcomeAt: (index: number) => Outcome | undefined;
  readonly chosen: number | null;
  /** Marks cells, as those whose outcome changed. */
  readonly isMarked: (index: number) => boolean;
}

/** Draws all cells. A success is a square, a failure has a hole, and what does not count is small. */
export function draw(
  context: CanvasRenderingContext2D,
  { cells, columns, outcomeAt, chosen, isMarked }: Drawn,
  colorOf: (token: string) => string,
): void {
  const size = CELL_PX - GAP_PX;
  for (let index = 0; index < cells; index += 1) {
    const x = (index % columns) * CELL_PX;
    const y = Math.floor(index / columns) * CELL_PX;
    const outcome = outcomeAt(index)?.outcome;
    context.fillStyle = colorOf(outcome ? COLORS[outcome] : '--bts-surface-3');
    const isSmall = outcome === 'invalid' || outcome === 'lost' || outcome === 'cancelled';
    const inset = isSmall ? size / 4 : 0;
    context.fillRect(x + inset, y + inset, size - 2 * inset, size - 2 * inset);
    if (outcome && outcome !== 'success' && !isSmall) {
      context.fillStyle = colorOf('--bts-surface');
      const hole = size / 3;
      context.fillRect(x + hole, y + hole, size - 2 * hole, size - 2 * hole);
    }
    if (isMarked(index)) {
      context.strokeStyle = colorOf('--bts-text');
      context.lineWidth = 1;
      context.strokeRect(x + 0.5, y + 0.5, size - 1, size - 1);
    }
    if (index === chosen) {
      context.strokeStyle = colorOf('--bts-accent');
      context.lineWidth = 2;
      context.strokeRect(x - 0.5, y - 0.5, size + 1, size + 1);
    }
  }
}
