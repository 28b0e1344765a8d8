import type { Diagram, DiagramNode, NodeId } from '../diagram';
import { placesOf, TREE, withValue, type Operation, type Place } from './operation';

/** A tree that is being changed: its lists are copied before they change. */
class Changing {
  private readonly nodes: Record<NodeId, DiagramNode>;
  private readonly places: Map<NodeId, Place>;
  private drafts: readonly NodeId[];
  private root: NodeId | null;
  private tree: Diagram;

  constructor(diagram: Diagram) {
    this.nodes = { ...diagram.nodes };
    this.places = placesOf(diagram);
    this.drafts = diagram.drafts;
    this.root = diagram.root;
    this.tree = diagram;
  }

  get diagram(): Diagram {
    return { ...this.tree, root: this.root, nodes: this.nodes, drafts: this.drafts };
  }

  /** Makes one change; returns false, and changes nothing, where it does not apply. */
  apply(change: Operation): boolean {
    if (change.id === TREE) {
      if (change.op !== 'set') return false;
      this.tree = withValue(this.tree, change.field, change.value);
      return true;
    }
    const node = this.nodes[change.id];
    if (change.op === 'create') {
      if (node) return false;
      this.nodes[change.id] = change.node;
      this.attach(change.id, 'draft', this.drafts.at(-1) ?? null);
      return true;
    }
    if (!node) return false;
    if (change.op === 'set') this.nodes[change.id] = withValue(node, change.field, change.value);
    else if (change.op === 'place') return this.place(change.id, change.at, change.after);
    else this.remove(change.id, node);
    return true;
  }

  private place(id: NodeId, at: Place, after: NodeId | null): boolean {
    if (typeof at === 'object' && (!this.nodes[at.parent] || this.isWithin(at.parent, id))) return false;
    this.detach(id);
    this.attach(id, at, after);
    return true;
  }

  /** What was below a removed node becomes drafts: nothing of others is lost. */
  private remove(id: NodeId, { children = [] }: DiagramNode): void {
    this.detach(id);
    for (const child of children) this.attach(child, 'draft', this.drafts.at(-1) ?? null);
    Reflect.deleteProperty(this.nodes, id);
    this.places.delete(id);
  }

  private isWithin(id: NodeId, ancestor: NodeId): boolean {
    for (let at: NodeId | undefined = id; at !== undefined;) {
      if (at === ancestor) return true;
      const place = this.places.get(at);
      at = typeof place === 'object' ? place.parent : undefined;
    }
    return false;
  }

  private detach(id: NodeId): void {
    const place = this.places.get(id);
    if (place === 'root') this.root = null;
    else if (place === 'draft') this.drafts = this.drafts.filter((each) => each !== id);
    else if (place) this.setChildren(place.parent, (children) => children.filter((each) => each !== id));
  }

  private attach(id: NodeId, at: Place, after: NodeId | null): void {
    if (at === 'root') {
      const before = this.root;
      this.root = id;
      if (before !== null && before !== id) this.attach(before, 'draft', this.drafts.at(-1) ?? null);
    } else if (at === 'draft') this.drafts = inserted(this.drafts, id, after);
    else this.setChildren(at.parent, (children) => inserted(children, id, after));
    this.places.set(id, at);
  }

  private setChildren(parent: NodeId, change: (children: readonly NodeId[]) => readonly NodeId[]): void {
    const node = this.nodes[parent];
    if (node) this.nodes[parent] = { ...node, children: change(node.children ?? []) };
  }
}

/** Returns the list with an ID after another; at its end where that is not in the list. */
function inserted(list: readonly NodeId[], id: NodeId, after: NodeId | null): readonly NodeId[] {
  const index = after === null ? 0 : list.indexOf(after) + 1;
  return after !== null && index === 0 ? [...list, id] : [...list.slice(0, index), id, ...list.slice(index)];
}

export interface Applied {
  readonly diagram: Diagram;
  readonly refused: readonly Operation[];
}

/**
 * Makes changes one after the other. Refused, each alone, are those of nodes that are gone, a node that is there
 * already, and a place below the node itself or below what is gone.
 */
export function applied(diagram: Diagram, changes: readonly Operation[]): Applied {
  const changing = new Changing(diagram);
  const refused = changes.filter((change) => !changing.apply(change));
  return { diagram: changing.diagram, refused };
}
