import type { Family } from '@/model/vocabulary';

const n = (value: number) => Math.round(value * 10) / 10;

function roundedRect(width: number, height: number, radius: number, inset: number): string {
  const r = Math.min(radius, height / 2 - inset, width / 2 - inset);
  const [l, t, right, b] = [inset, inset, n(width - inset), n(height - inset)];
  return `M${l + r} ${t}H${right - r}A${r} ${r} 0 0 1 ${right} ${t + r}V${b - r}A${r} ${r} 0 0 1 ${right - r} ${b}H${l + r}A${r} ${r} 0 0 1 ${l} ${b - r}V${t + r}A${r} ${r} 0 0 1 ${l + r} ${t}Z`;
}

function chamfered(width: number, height: number, cut: number, inset: number): string {
  const [l, t, r, b] = [inset, inset, n(width - inset), n(height - inset)];
  return `M${l + cut} ${t}H${r - cut}L${r} ${t + cut}V${b - cut}L${r - cut} ${b}H${l + cut}L${l} ${b - cut}V${t + cut}Z`;
}

/**
 * Returns the outline of a block, a palette row or a legend entry; its shape distinguishes families without
 * colour.
 */
export function outline(family: Family | null, width: number, height: number, inset = 1): string {
  switch (family) {
    case 'condition':
      return roundedRect(width, height, 22, inset);
    case 'decorator':
      return chamfered(width, height, 11, inset);
    case 'action':
      return roundedRect(width, height, 5, inset);
    case 'control':
    case 'subtree':
    case null:
      return roundedRect(width, height, 11, inset);
  }
}

const RADIUS = 12;

/**
 * Returns an orthogonal line with round corners. The line bends at the same place for all siblings, so that
 * they share the bend.
 */
export function elbow(x1: number, y1: number, x2: number, y2: number, isHorizontal: boolean): string {
  if (isHorizontal) {
    const middle = x1 + Math.min(28, (x2 - x1) / 2);
    const r = Math.min(RADIUS, Math.abs(y2 - y1) / 2, Math.abs(x2 - x1) / 2);
    const turn = y2 > y1 ? 1 : -1;
    if (r < 1) return `M${x1} ${y1}L${x2} ${y2}`;
    return `M${x1} ${y1}H${middle - r}Q${middle} ${y1} ${middle} ${y1 + turn * r}V${y2 - turn * r}Q${middle} ${y2} ${middle + r} ${y2}H${x2}`;
  }
  const middle = y1 + Math.min(28, (y2 - y1) / 2);
  const r = Math.min(RADIUS, Math.abs(x2 - x1) / 2, Math.abs(y2 - y1) / 2);
  const turn = x2 > x1 ? 1 : -1;
  if (r < 1) return `M${x1} ${y1}L${x2} ${y2}`;
  return `M${x1} ${y1}V${middle - r}Q${x1} ${middle} ${x1 + turn * r} ${middle}H${x2 - turn * r}Q${x2} ${middle} ${x2} ${middle + r}V${y2}`;
}
