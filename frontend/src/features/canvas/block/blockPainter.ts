import type { NodeStatus } from '@/generated/messages';
import { write, type ShownStatus } from '@/store/moment/statusPainter';
import type { Flash } from '@/store/project/live';

type Marked = Exclude<NodeStatus, 'IDLE'>;

/** The shapes of the icons, in a square of 24, as in Tabler's set; a line is drawn, the others are filled. */
const ICONS: Record<Marked, { readonly d: string; readonly isLine: boolean }> = {
  RUNNING: {
    d: 'M6 4v16a1 1 0 0 0 1.524 .852l13 -8a1 1 0 0 0 0 -1.704l-13 -8a1 1 0 0 0 -1.524 .852z',
    isLine: false,
  },
  SUCCESS: { d: 'M5 12l5 5l10 -10', isLine: true },
  FAILURE: { d: 'M18 6l-12 12M6 6l12 12', isLine: true },
  SKIPPED: {
    d:
      'M3 5v14a1 1 0 0 0 1.504 .864l12 -7a1 1 0 0 0 0 -1.728l-12 -7a1 1 0 0 0 -1.504 .864z' +
      'M20 4a1 1 0 0 1 .993 .883l.007 .117v14a1 1 0 0 1 -1.993 .117l-.007 -.117v-14a1 1 0 0 1 1 -1z',
    isLine: false,
  },
};
const SVG = 'http://www.w3.org/2000/svg';
const SIZE = '11';
const LINE_WIDTH = '3.2';
const drawn = new Map<Marked, SVGElement>();

function iconOf(status: Marked): Node {
  let icon = drawn.get(status);
  if (!icon) {
    const { d, isLine } = ICONS[status];
    icon = document.createElementNS(SVG, 'svg');
    const path = document.createElementNS(SVG, 'path');
    const line = { fill: 'none', stroke: 'currentColor', 'stroke-width': LINE_WIDTH };
    const ends = { 'stroke-linecap': 'round', 'stroke-linejoin': 'round' };
    const look = isLine ? { ...line, ...ends } : { fill: 'currentColor' };
    for (const [name, value] of Object.entries({ width: SIZE, height: SIZE, viewBox: '0 0 24 24', ...look }))
      icon.setAttribute(name, value);
    path.setAttribute('d', d);
    icon.append(path);
    drawn.set(status, icon);
  }
  return icon.cloneNode(true);
}

/**
 * Returns a function that paints the status on a block and on the mark at its corner, which is an icon in
 * addition to the colour. The icon is hollow for a status of the last tick only; it fades for an earlier status
 * that the next tick did not repeat.
 */
export function blockPainter(block: Element, mark: Element): (shown: ShownStatus) => void {
  let beat = false;
  let last: Flash | undefined;
  return ({ status: own, past, flash, hasFault }) => {
    const status = hasFault ? 'FAILURE' : own;
    const isPast = status === 'IDLE' && past !== undefined;
    const isPassing = status === 'IDLE' && !isPast && flash !== undefined;
    write(block, 'data-status', own);
    write(block, 'data-past', past);
    write(block, 'data-flash', flash?.status);
    // A flash that repeats starts its animation again: two animations of the same look take turns.
    if (flash !== last) beat = !beat;
    last = flash;
    write(block, 'data-beat', flash && beat ? '' : undefined);
    paintMark(mark, isPast ? past : isPassing ? flash.status : status);
    write(mark, 'data-past', isPast ? '' : undefined);
    write(mark, 'data-passing', isPassing ? '' : undefined);
  };
}

function paintMark(mark: Element, status: NodeStatus): void {
  if (status === 'IDLE') {
    mark.replaceChildren();
    mark.removeAttribute('data-status');
  } else if (mark.getAttribute('data-status') !== status) {
    mark.replaceChildren(iconOf(status));
    mark.setAttribute('data-status', status);
  }
}
