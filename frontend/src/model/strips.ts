import type { Box } from './layout';

interface Least {
  readonly width: number;
  readonly height: number;
}

/** The shape of a box in which a name is read best: its width by its height. */
const SHAPE = 2.4;
const MOST_ROWS = 60;
/** How much worse a box without room for its name is than one of a bad shape. */
const TOO_SMALL = 8;

/** Divides weights into rows of about equal sums, in their order. */
function rowsOf(weights: readonly number[], count: number): number[][] {
  const share = weights.reduce((sum, each) => sum + each, 0) / count;
  const rows: number[][] = [[]];
  let before = 0;
  weights.forEach((weight, index) => {
    const row = rows.at(-1) ?? [];
    // An item belongs to the row in which its middle lies.
    if (row.length > 0 && rows.length < count && before + weight / 2 > share * rows.length)
      rows.push([index]);
    else row.push(index);
    before += weight;
  });
  return rows;
}

/** Divides a length in proportion to weights, but gives each part a least length if there is enough for all. */
function divided(length: number, weights: readonly number[], least: number): number[] {
  const parts: number[] = [];
  const small = new Set<number>();
  if (least * weights.length > length) return weights.map(() => length / weights.length);
  for (let isFound = true; isFound;) {
    isFound = false;
    const others = weights.reduce((sum, each, i) => (small.has(i) ? sum : sum + each), 0);
    weights.forEach((weight, i) => {
      parts[i] = small.has(i) ? least : ((length - least * small.size) * weight) / others;
    });
    parts.forEach((part, i) => {
      if (part >= least || small.has(i)) return;
      small.add(i);
      isFound = true;
    });
  }
  return parts;
}

function boxesOf(
  weights: readonly number[],
  rows: readonly number[][],
  box: Box,
  least: Least,
  gap: number,
): Box[] {
  const sumOf = (row: readonly number[]) => row.reduce((sum, i) => sum + (weights[i] ?? 0), 0);
  const heights = divided(box.height - gap * (rows.length - 1), rows.map(sumOf), least.height);
  const boxes: Box[] = [];
  let y = box.y;
  rows.forEach((row, at) => {
    const height = heights[at] ?? 0;
    const own = row.map((i) => weights[i] ?? 0);
    let x = box.x;
    for (const width of divided(box.width - gap * (row.length - 1), own, least.width)) {
      boxes.push({ x, y, width, height });
      x += width + gap;
    }
    y += height + gap;
  });
  return boxes;
}

function badness(boxes: readonly Box[], least: Least): number {
  let sum = 0;
  for (const { width, height } of boxes) {
    if (width < least.width || height < least.height) sum += TOO_SMALL;
    if (width > 0 && height > 0) sum += Math.abs(Math.log(width / height / SHAPE));
  }
  return sum / boxes.length;
}

/**
 * Divides a box into one box for each weight, of proportional area, in rows that are read like text. Of all
 * numbers of rows, the one is taken whose boxes have the best shape for a name. None is smaller than `least` where there
 * is room for that.
 */
export function strips(weights: readonly number[], box: Box, least: Least, gap: number): Box[] {
  let best: Box[] = [];
  let lowest = Infinity;
  for (let count = 1; count <= Math.min(weights.length, MOST_ROWS); count += 1) {
    const boxes = boxesOf(weights, rowsOf(weights, count), box, least, gap);
    const bad = badness(boxes, least);
    if (bad < lowest) [best, lowest] = [boxes, bad];
  }
  return best;
}
