import type { NodeStatus } from '@/generated/messages';
import type { ChangeKind } from '@/model/difference/changes';
import type { NodeId } from '@/model/diagram';
import { cellOf, type Part } from '@/model/nested';
import { busiest, type LiveKey } from '@/store/project/live';
import type { ShownStatus } from '@/store/moment/statusPainter';
import type { Facts, FactsOf } from './facts';

type Shown = Exclude<NodeStatus, 'IDLE'>;

/** The names of the theme's colours. */
const STATUS_COLORS: Record<Shown, string> = {
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

/** Returns the status in whose colour a block is drawn; null while it is idle. */
function drawnStatus({ status, past, hasFault }: ShownStatus): Shown | null {
  if (hasFault) return 'FAILURE';
  const shown = status === 'IDLE' ? past : status;
  return shown === undefined || shown === 'IDLE' ? null : shown;
}

export interface Picture {
  readonly parts: readonly Part[];
  readonly facts: FactsOf;
  readonly marks: ReadonlyMap<NodeId, ChangeKind>;
  readonly hits: ReadonlySet<NodeId>;
  readonly statusOf: (key: LiveKey) => ShownStatus;
  /** Returns a colour by its name in the theme. */
  readonly colorOf: (token: string) => string;
}

/** A cell is drawn a little smaller than it is, so that neighbours are distinguished. */
const BETWEEN = 0.16;
/** Cells without a status are pale: what runs is seen first. */
const IDLE_ALPHA = 0.42;
const RING = 2;

/** Returns what is shown of several blocks together: what runs wins, and a fault is never hidden. */
export function together(all: readonly ShownStatus[]): ShownStatus {
  const status = busiest(all.map((each) => each.status));
  const past = status === 'IDLE' ? busiest(all.map((each) => each.past ?? 'IDLE')) : 'IDLE';
  return {
    status,
    past: past === 'IDLE' ? undefined : past,
    flash: undefined,
    hasFault: all.some(({ hasFault }) => hasFault),
  };
}

/** Draws the blocks of all pieces as cells, each in the colour of its status, or of its family while it is idle. */
export function drawCells(context: CanvasRenderingContext2D, picture: Picture): void {
  const { parts, facts, statusOf, colorOf } = picture;
  for (const { piece } of parts) {
    piece?.blocks.forEach((id, index) => {
      const fact = facts.get(id);
      if (!fact) return;
      const { x, y, width } = cellOf(piece, index);
      const between = width * BETWEEN;
      const box = [x + between / 2, y + between / 2, width - between, width - between] as const;
      const status = drawnStatus(statusOf(fact.key));
      context.globalAlpha = status === null ? IDLE_ALPHA : 1;
      context.fillStyle =
        status === null
          ? (fact.node.color ?? colorOf(fact.family ?? 'unknown'))
          : colorOf(STATUS_COLORS[status]);
      context.fillRect(...box);
      context.globalAlpha = 1;
      const ring = ringOf(picture, fact);
      if (ring === null) return;
      context.strokeStyle = colorOf(ring);
      context.lineWidth = RING;
      context.strokeRect(...box);
    });
  }
}

function ringOf({ marks, hits }: Picture, { id, isSelected, hasError }: Facts): string | null {
  if (isSelected || hits.has(id)) return 'accent';
  const kind = marks.get(id);
  if (kind) return MARK_COLORS[kind];
  return hasError ? 'failure-bright' : null;
}
