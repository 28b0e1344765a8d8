import { create } from 'zustand';
import type { NodeId } from '@/model/diagram';
import { CopyGhost } from './copyGhost';

/** The offset of dragged blocks from their places in the layout; the edges to `tops` are drawn again. */
interface DraggedBlocks {
  readonly tops: ReadonlySet<NodeId>;
  readonly dx: number;
  readonly dy: number;
}

const NOTHING: DraggedBlocks = { tops: new Set(), dx: 0, dy: 0 };

export const useDraggedBlocks = create<DraggedBlocks>(() => NOTHING);

/**
 * Moves dragged blocks with the pointer. It sets the CSS property `translate`, which React does not set, on
 * the drawn elements, so that no block renders, however many blocks move. Each step queries the page again,
 * to include blocks that have come into view. In a copy the blocks stay in place, and a ghost of them moves.
 */
export class BlockDrag {
  private by = { dx: 0, dy: 0 };
  private ghost: CopyGhost | null = null;

  constructor(
    private readonly canvas: HTMLElement,
    readonly holds: NodeId,
    readonly tops: ReadonlySet<NodeId>,
    private readonly ids: ReadonlySet<NodeId>,
  ) {}

  moveBy(dx: number, dy: number, isCopy: boolean): void {
    this.by = { dx, dy };
    this.copy(isCopy);
  }

  /** Switches between moving and copying without moving the pointer. */
  copy(isCopy: boolean): void {
    const { dx, dy } = this.by;
    if (isCopy) {
      if (!this.ghost) this.putBack();
      this.ghost ??= new CopyGhost(this.canvas, this.holds, this.drawn());
      this.ghost.moveBy(dx, dy);
      return;
    }
    this.removeGhost();
    this.translate(`${dx}px ${dy}px`);
    useDraggedBlocks.setState({ tops: this.tops, dx, dy });
  }

  letGo(): void {
    this.removeGhost();
    this.putBack();
  }

  private removeGhost(): void {
    this.ghost?.remove();
    this.ghost = null;
  }

  private putBack(): void {
    this.translate('');
    useDraggedBlocks.setState(NOTHING);
  }

  private drawn(): HTMLElement[] {
    const nodes = this.canvas.querySelectorAll<HTMLElement>('.react-flow__node');
    return [...nodes].filter(({ dataset }) => this.ids.has(dataset['id'] ?? ''));
  }

  private translate(by: string): void {
    for (const element of this.drawn()) element.style.translate = by;
    for (const element of this.canvas.querySelectorAll<SVGElement>('.react-flow__edge')) {
      const child = element.dataset['id'] ?? '';
      if (this.ids.has(child) && !this.tops.has(child)) element.style.translate = by;
    }
  }
}
