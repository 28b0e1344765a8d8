import { useEffect, useState } from 'react';
import type { Step } from './guide';
import type { Rect } from './place';

const LOOK_AGAIN_MS = 250;

/** The places where each step is done, the best first; the last one exists in every layout. */
const PLACES: Record<Step, readonly string[]> = {
  block: ['[data-testid="ghost-block"]', '[data-testid="palette"]'],
  fill: [
    '[data-testid="inspector"] [data-testid^="port-"]',
    '[data-testid="canvas"] .react-flow__node.selected',
  ],
  run: ['[data-testid="run"]'],
};
const CANVAS = '[data-testid="canvas"]';

export interface Target extends Rect {
  /** Whether the place itself is not visible, so that the canvas is marked instead. */
  readonly isFarOff: boolean;
}

function rectOf(selector: string): Rect | null {
  for (const element of document.querySelectorAll(selector)) {
    if (!element.checkVisibility()) continue;
    const { left, top, width, height } = element.getBoundingClientRect();
    const isSeen = width > 0 && top >= 0 && left >= 0 && top < innerHeight && left < innerWidth;
    if (isSeen) return { left, top, width, height };
  }
  return null;
}

export function findTarget(step: Step): Target | null {
  for (const place of PLACES[step]) {
    const rect = rectOf(place);
    if (rect) return { ...rect, isFarOff: false };
  }
  const canvas = rectOf(CANVAS);
  return canvas && { ...canvas, isFarOff: true };
}

const isSame = (a: Target | null, b: Target | null): boolean =>
  a === b ||
  (a !== null && b !== null && (Object.keys(a) as (keyof Target)[]).every((key) => a[key] === b[key]));

/** Returns the place where a step is done. It is searched repeatedly, since panels move and scroll. */
export function useTarget(step: Step | null): Target | null {
  const [target, setTarget] = useState<Target | null>(null);
  useEffect(() => {
    if (step === null) return undefined;
    const look = () => {
      const found = findTarget(step);
      setTarget((before) => (isSame(before, found) ? before : found));
    };
    look();
    const timer = setInterval(look, LOOK_AGAIN_MS);
    window.addEventListener('resize', look);
    return () => {
      clearInterval(timer);
      window.removeEventListener('resize', look);
    };
  }, [step]);
  return step === null ? null : target;
}
