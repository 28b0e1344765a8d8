import { BIT } from '@/store/session/trace/nodeTrace';
import type { Trace } from '@/store/session/trace/trace';
import { marks, timeLabel, type Span } from './span';

export const ROW_PX = 24;
export const AXIS_PX = 22;
const PADDING_PX = 3;

export interface Palette {
  surface: string;
  line: string;
  text: string;
  running: string;
  success: string;
  failure: string;
  skipped: string;
  moment: string;
}

export function paletteOf(element: Element): Palette {
  const style = getComputedStyle(element);
  const of = (name: string) => style.getPropertyValue(`--bts-${name}`).trim();
  return {
    surface: of('surface'),
    line: of('border'),
    text: of('muted'),
    running: of('running-bright'),
    success: of('success-bright'),
    failure: of('failure-bright'),
    skipped: of('skipped'),
    moment: of('text'),
  };
}

/** The height of a mark of time on the axis, in px. */
const TIME_PX = 6;

interface Picture {
  context: CanvasRenderingContext2D;
  width: number;
  height: number;
  span: Span;
  /** The nodes in the rows, from top to bottom. */
  uids: readonly number[];
  scrollTop: number;
  palette: Palette;
  /** The moment at which the user looks; null: the present. */
  moment?: number | null;
}

/** Draws the axis and the visible strips; hidden rows cost no time. */
export function drawTimeline(trace: Trace, picture: Picture): void {
  const { context, width, height, span, uids, scrollTop, palette } = picture;
  context.clearRect(0, 0, width, height);
  const scale = width / (span.to - span.from);
  const xOf = (t: number) => (t - span.from) * scale;

  context.font = '11px Inter Variable, system-ui, sans-serif';
  context.textBaseline = 'middle';
  for (const mark of marks(span, width)) {
    const x = Math.round(xOf(mark)) + 0.5;
    context.fillStyle = palette.line;
    context.fillRect(x - 0.5, AXIS_PX - 5, 1, height);
    context.fillStyle = palette.text;
    context.fillText(timeLabel(mark), x + 4, AXIS_PX / 2);
  }
  context.fillStyle = palette.line;
  context.fillRect(0, AXIS_PX - 1, width, 1);

  context.save();
  context.beginPath();
  context.rect(0, AXIS_PX, width, height - AXIS_PX);
  context.clip();
  const first = Math.floor(scrollTop / ROW_PX);
  const last = Math.min(uids.length, Math.ceil((scrollTop + height - AXIS_PX) / ROW_PX));
  for (let row = first; row < last; row++) {
    const top = AXIS_PX + row * ROW_PX - scrollTop;
    for (const { start, end, mask } of trace.stretches(uids[row] ?? -1, span.from, span.to)) {
      const left = Math.max(xOf(start), 0);
      drawStretch(context, mask, left, Math.max(xOf(end) - left, 1), top, palette);
    }
  }
  context.restore();

  const { moment = null } = picture;
  if (moment !== null && moment >= span.from && moment <= span.to) {
    context.fillStyle = palette.moment;
    context.fillRect(Math.round(xOf(moment)) - 1, 0, 2, height);
  }

  const now = xOf(trace.now);
  if (now >= 0 && now <= width) {
    context.fillStyle = palette.text;
    context.fillRect(Math.min(Math.round(now), width - 1), AXIS_PX - 5, 1, height);
  }
}

/** Draws marks of simulated time over what is drawn already, at round times that have room for their texts. */
export function drawTimes(
  context: CanvasRenderingContext2D,
  span: Span,
  width: number,
  palette: Palette,
): void {
  const scale = width / (span.to - span.from);
  context.font = '10px Inter Variable, system-ui, sans-serif';
  context.textBaseline = 'top';
  context.lineWidth = 3;
  context.lineJoin = 'round';
  for (const mark of marks(span, width)) {
    const x = Math.round((mark - span.from) * scale);
    context.fillStyle = palette.moment;
    context.fillRect(x, 0, 1, TIME_PX);
    // A rim keeps the text readable on every status.
    context.strokeStyle = palette.surface;
    context.strokeText(timeLabel(mark), x + 4, 1);
    context.fillText(timeLabel(mark), x + 4, 1);
  }
}

/**
 * Draws a status by colour and by place, so that either suffices: running fills the row, success its lower
 * half, failure its upper half, and skipped is a line.
 */
export function drawStretch(
  context: CanvasRenderingContext2D,
  mask: number,
  x: number,
  width: number,
  top: number,
  palette: Palette,
): void {
  const y = top + PADDING_PX;
  const full = ROW_PX - 2 * PADDING_PX;
  const part = Math.round(full * 0.55);
  const fill = (color: string, from: number, height: number) => {
    context.fillStyle = color;
    context.fillRect(x, from, width, height);
  };
  if (mask & BIT.RUNNING) fill(palette.running, y, full);
  if (mask & BIT.SUCCESS) fill(palette.success, y + full - part, part);
  if (mask & BIT.FAILURE) fill(palette.failure, y, part);
  if (mask & BIT.SKIPPED) fill(palette.skipped, y + full / 2 - 1, 2);
}
