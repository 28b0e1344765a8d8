import { preorder, type Diagram, type DiagramNode, type NodeId } from '../diagram';
import { setComment, setCondition, setName, setPort, type Recipe } from '../edits';

/** The kind of a block's text. Types, trees and names of ports are references, and are not replaced. */
export type Field =
  | { readonly part: 'name' | 'type' | 'tree' | 'comment' }
  | { readonly part: 'port' | 'portName' | 'condition' | 'attribute'; readonly name: string };

/** The place of a text: in a block of a tree; null for the text of a file. */
export type Place = { readonly node: NodeId; readonly field: Field } | null;

/** A text that is searched. */
export interface Passage {
  readonly path: string;
  readonly place: Place;
  readonly text: string;
}

const ENTRIES = [
  ['port', 'ports'],
  ['condition', 'conditions'],
  ['attribute', 'attributes'],
] as const;

function textsOf(node: DiagramNode): (readonly [Field, string])[] {
  const { name, type, tree, comment } = node;
  const plain = { name, type, tree, comment };
  const own = (['name', 'type', 'tree', 'comment'] as const).flatMap((part) => {
    const text = plain[part];
    return text ? [[{ part }, text] as const] : [];
  });
  const entries = ENTRIES.flatMap(([part, field]) =>
    Object.entries(node[field] ?? {}).flatMap(([key, text]): (readonly [Field, string])[] => [
      ...(part === 'port' ? [[{ part: 'portName', name: key }, key] as const] : []),
      [{ part, name: key }, text],
    ]),
  );
  return [...own, ...entries];
}

/** Returns all texts of a tree, in execution order of its blocks. */
export function passagesOf(path: string, diagram: Diagram): Passage[] {
  return preorder(diagram).flatMap((node) => {
    const found = diagram.nodes[node];
    return found ? textsOf(found).map(([field, text]) => ({ path, place: { node, field }, text })) : [];
  });
}

const REPLACEABLE: readonly Field['part'][] = ['name', 'comment', 'port', 'condition'];

/**
 * Returns whether a text can be replaced. References and the project's settings have commands of their own.
 */
export const canReplace = ({ path, place }: Passage): boolean =>
  place ? REPLACEABLE.includes(place.field.part) : path !== 'project.json';

/** Returns the current text at a place; undefined if the place does not exist any more. */
export function textAt({ nodes }: Diagram, { node: id, field }: NonNullable<Place>): string | undefined {
  const node = nodes[id];
  if (!node) return undefined;
  return textsOf(node).find(([other]) => JSON.stringify(other) === JSON.stringify(field))?.[1];
}

/** Sets the text at a place whose text can be replaced. */
export function setText({ node, field }: NonNullable<Place>, text: string): Recipe {
  switch (field.part) {
    case 'name':
      return setName(node, text);
    case 'comment':
      return setComment(node, text);
    case 'port':
      return setPort(node, field.name, text);
    case 'condition':
      return setCondition(node, field.name, text);
    case 'type':
    case 'tree':
    case 'portName':
    case 'attribute':
      return () => undefined;
  }
}
