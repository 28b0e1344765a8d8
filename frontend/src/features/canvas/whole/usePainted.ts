import { useEffect, type RefObject } from 'react';
import type { Room } from '@/model/nested';
import { onStatuses, shownStatus, write, type ShownStatus } from '@/store/moment/statusPainter';
import { blockPainter } from '../block/blockPainter';
import { drawCells, together, type Picture } from './wholePainter';

type Paint = () => void;

/**
 * Paints the statuses on the boxes and pieces in `root` and draws their cells, outside of React: at most once a
 * frame, when statuses or the theme changed. Hundreds of elements would be rendered twenty times a second.
 */
export function usePainted(
  root: RefObject<HTMLElement | null>,
  canvas: RefObject<HTMLCanvasElement | null>,
  { parts, facts, marks, hits }: Omit<Picture, 'statusOf' | 'colorOf'>,
  { width, height }: Room,
): void {
  useEffect(() => {
    const element = canvas.current;
    // Drawn by the processor: an emulated GPU takes seconds for what that does in a millisecond.
    const context = element?.getContext('2d', { willReadFrequently: true });
    let colors = new Map<string, string>();
    const colorOf = (token: string): string => {
      let found = colors.get(token);
      if (found === undefined && element)
        colors.set(token, (found = getComputedStyle(element).getPropertyValue(`--bts-${token}`)));
      return found ?? '';
    };
    const paints = root.current ? paintsOf(root.current, { parts, facts }) : [];
    const ratio = window.devicePixelRatio || 1;
    if (element) resize(element, Math.round(width * ratio), Math.round(height * ratio));
    let request = 0;
    const draw = () => {
      request = 0;
      paints.forEach((paint) => paint());
      if (!context) return;
      context.setTransform(ratio, 0, 0, ratio, 0, 0);
      context.clearRect(0, 0, width, height);
      drawCells(context, { parts, facts, marks, hits, statusOf: shownStatus, colorOf });
    };
    const drawSoon = () => {
      if (request === 0) request = requestAnimationFrame(draw);
    };
    const themed = new MutationObserver(() => {
      colors = new Map();
      drawSoon();
    });
    themed.observe(document.documentElement, { attributeFilter: ['data-mantine-color-scheme'] });
    const stop = onStatuses(drawSoon);
    draw();
    return () => {
      cancelAnimationFrame(request);
      themed.disconnect();
      stop();
    };
  }, [root, canvas, parts, facts, marks, hits, width, height]);
}

function resize(element: HTMLCanvasElement, width: number, height: number): void {
  if (element.width !== width) element.width = width;
  if (element.height !== height) element.height = height;
}

function paintPiece(element: Element, { status, past, hasFault }: ShownStatus): void {
  write(element, 'data-status', hasFault ? 'FAILURE' : status);
  write(element, 'data-past', hasFault ? undefined : past);
}

/** Returns a function for each box and piece that paints what it shows now. */
function paintsOf(root: HTMLElement, { parts, facts }: Pick<Picture, 'parts' | 'facts'>): Paint[] {
  const elements = new Map(
    [...root.querySelectorAll<HTMLElement>('[data-part]')].map((each) => [each.dataset['part'], each]),
  );
  const paints: Paint[] = [];
  for (const { id, piece } of parts) {
    const [element, key] = [elements.get(id), facts.get(id)?.key];
    const [mark, below] = [element?.querySelector('[data-mark-of]'), element?.querySelector('[data-piece]')];
    if (element && mark && key !== undefined) {
      const paint = blockPainter(element, mark);
      paints.push(() => paint(shownStatus(key)));
    }
    if (!below || !piece) continue;
    const keys = piece.blocks.flatMap((each) => facts.get(each)?.key ?? []);
    paints.push(() => paintPiece(below, together(keys.map(shownStatus))));
  }
  return paints;
}
