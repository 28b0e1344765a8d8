import type { NodeStatus } from '@/generated/messages';
import type { ChangeKind } from '@/model/difference/changes';
import type { NodeId } from '@/model/diagram';
import { liveKey } from '@/store/project/live';
import type { ShownStatus } from '@/store/moment/statusPainter';
import { elbow } from '@/ui/shapes';
import type { BlockNode, TreeEdge } from '../flow';

/** The zoom below which all blocks are drawn in one picture: their symbols would have seven pixels. */
export const TINY = 0.15;

/** The smallest width and height of a block, and of a ring around it, in px. */
const LEAST = { width: 1, height: 2, ring: 1.5 } as const;
/** A block from this height on, in px, has the colour of its family with a ring; a lower one its status alone. */
const RINGED = 6;
const SELECTED_PX = 3;

export type View = readonly [x: number, y: number, zoom: number];

export interface TinyTree {
  readonly nodes: readonly BlockNode[];
  readonly edges: readonly TreeEdge[];
  readonly marks: ReadonlyMap<NodeId, ChangeKind>;
  readonly statusOf: (key: string) => ShownStatus;
  /** Returns a colour by its name in the theme. */
  readonly colorOf: (token: string) => string;
}

type Shown = Exclude<NodeStatus, 'IDLE'>;
const COLORS: Record<Shown, string> = {
  RUNNING: 'running-bright',
  SUCCESS: 'success-bright',
  FAILURE: 'failure-bright',
  SKIPPED: 'skipped',
};
const MARK_COLORS: Record<ChangeKind, string> = {
  added: 'success',
  removed: 'failure',
  changed: 'running',
  moved: 'accent',
};

const keyOf = ({ id, data: { tree, inside } }: BlockNode): string =>
  inside ? liveKey(inside.tree, inside.node) : liveKey(tree, id);

/** Returns the status in whose colour a block or edge is drawn; null while it is idle. */
function drawnStatus({ status, past, hasFault }: ShownStatus): Shown | null {
  if (hasFault) return 'FAILURE';
  const shown = status === 'IDLE' ? past : status;
  return shown === undefined || shown === 'IDLE' ? null : shown;
}

/** The lines between the blocks, in the measure of the tree; they change with its layout alone. */
export function pathsOf({ nodes, edges }: Pick<TinyTree, 'nodes' | 'edges'>): Map<NodeId, Path2D> {
  const boxes = new Map(nodes.map((node) => [node.id, node]));
  const paths = new Map<NodeId, Path2D>();
  for (const { source, target, data } of edges) {
    const [from, to] = [boxes.get(source), boxes.get(target)];
    if (!from || !to) continue;
    const isHorizontal = data?.isHorizontal ?? false;
    const [w, h] = [from.width ?? 0, from.height ?? 0];
    const begin = isHorizontal
      ? ([from.position.x + w, from.position.y + h / 2] as const)
      : ([from.position.x + w / 2, from.position.y + h] as const);
    const end = isHorizontal
      ? ([to.position.x, to.position.y + (to.height ?? 0) / 2] as const)
      : ([to.position.x + (to.width ?? 0) / 2, to.position.y] as const);
    paths.set(target, new Path2D(elbow(...begin, ...end, isHorizontal)));
  }
  return paths;
}

/** Draws a tree that is seen from so far that its blocks have a few pixels. The context is that of the screen. */
export function drawTiny(
  context: CanvasRenderingContext2D,
  tree: TinyTree,
  paths: ReadonlyMap<NodeId, Path2D>,
  [x, y, zoom]: View,
): void {
  const shown = new Map(tree.nodes.map((node) => [node.id, drawnStatus(tree.statusOf(keyOf(node)))]));
  context.save();
  context.translate(x, y);
  context.scale(zoom, zoom);
  for (const status of [null, 'SKIPPED', 'SUCCESS', 'FAILURE', 'RUNNING'] as const) {
    context.strokeStyle = tree.colorOf(status === null ? 'edge' : COLORS[status]);
    context.lineWidth = (status === null ? 0.75 : LEAST.ring) / zoom;
    const all = new Path2D();
    for (const [id, path] of paths) if ((shown.get(id) ?? null) === status) all.addPath(path);
    context.stroke(all);
  }
  context.restore();
  for (const node of tree.nodes) drawBlock(context, tree, node, shown.get(node.id) ?? null, [x, y, zoom]);
}

function drawBlock(
  context: CanvasRenderingContext2D,
  { marks, colorOf }: TinyTree,
  { id, position, width = 0, height = 0, data, selected }: BlockNode,
  status: Shown | null,
  [x, y, zoom]: View,
): void {
  const [w, h] = [Math.max(LEAST.width, width * zoom), Math.max(LEAST.height, height * zoom)];
  const box = [x + position.x * zoom, y + position.y * zoom, w, h] as const;
  const family = data.node.color ?? colorOf(data.spec?.family ?? 'unknown');
  const isRinged = h >= RINGED;
  context.fillStyle = status !== null && !isRinged ? colorOf(COLORS[status]) : family;
  context.fillRect(...box);
  const ring = (color: string, ringWidth: number) => {
    context.strokeStyle = color;
    context.lineWidth = ringWidth;
    context.strokeRect(...box);
  };
  if (status !== null && isRinged) ring(colorOf(COLORS[status]), Math.max(LEAST.ring, 7 * zoom));
  const kind = marks.get(id);
  if (kind) ring(colorOf(MARK_COLORS[kind]), LEAST.ring);
  if (selected) ring(colorOf('accent'), SELECTED_PX);
}
