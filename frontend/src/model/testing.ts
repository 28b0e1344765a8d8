import fc from 'fast-check';
import document from '@catalog';
import { childrenOf, freshId, isWithin, preorder, topsOf, type Diagram, type NodeId } from './diagram';
import {
  addNode,
  fragmentOf,
  insertFragment,
  moveNode,
  morph,
  removeSubtrees,
  reorder,
  setCollapsed,
  setComment,
  setDisabled,
  setName,
  setPort,
  tidy,
  unwrap,
  withFreshIds,
  wrap,
  type Recipe,
} from './edits';
import { acceptsChild, bestPlacement, canMorph, canMoveUnder, canUnwrap, canWrapIn } from './rules';
import type { TreeFacts } from './treeFacts';
import { makeVocabulary, readCatalog, type ActionDescription, type Vocabulary } from './vocabulary';

const actions: ActionDescription[] = [
  {
    name: 'Turn',
    kind: 'Action',
    open: false,
    ports: [{ name: 'ang_speed', direction: 'input', type: 'double' }],
  },
  { name: 'Free', kind: 'Action', open: true, ports: [] },
];

export const vocabulary: Vocabulary = makeVocabulary(
  readCatalog(document),
  actions,
  new Map<string, TreeFacts>([
    ['MainTree', { calls: new Set(), passed: new Map(), ports: [], description: '' }],
    [
      'Inner',
      {
        calls: new Set(),
        passed: new Map(),
        description: '',
        ports: [
          {
            name: 'far',
            direction: 'input',
            type: 'double',
            default: null,
            required: false,
            description: '',
          },
        ],
      },
    ],
  ]),
  'MainTree',
);

const types = [...vocabulary.specs.keys()].filter((type) => type !== 'SubTree');

/** Returns a legal edit, chosen by three numbers; null if there is none. */
export function legalStep(diagram: Diagram, what: number, where: number, which: number): Recipe | null {
  const ids = preorder(diagram);
  const pick = (n: number): NodeId | undefined => ids[n % Math.max(1, ids.length)];
  const id = pick(where);
  const type = types[which % types.length] ?? 'Sequence';
  const spec = vocabulary.specs.get(type);
  let seed = what * 7919 + where * 104729 + which;
  const random = () => {
    seed = (seed * 1664525 + 1013904223) % 4294967296;
    return seed / 4294967296;
  };
  const fresh = freshId(diagram.nodes, random);
  if (id === undefined) return addNode(fresh, { type }, { at: 'root' });
  switch (what % 13) {
    case 0:
    case 1:
    case 2:
      return addNode(fresh, { type }, bestPlacement(diagram, id, vocabulary));
    case 3: {
      const target = pick(which);
      return target !== undefined && canMoveUnder(diagram, id, target, vocabulary)
        ? moveNode(id, { at: 'child', parent: target, index: which % 5 })
        : null;
    }
    case 4:
      return reorder([id], (which % 5) - 2);
    case 5:
      return which % 3 === 0 ? removeSubtrees([id]) : null;
    case 6:
      return canUnwrap(diagram, id, vocabulary) ? unwrap(id) : null;
    case 7:
      return spec && canWrapIn(spec) ? wrap([id], fresh, { type }) : null;
    case 8:
      return spec && canMorph(diagram, id, spec) ? morph(id, { type }, () => true) : null;
    case 9: {
      const parent = ids.find(
        (each) => acceptsChild(diagram, each, vocabulary) && !isWithin(diagram, each, id),
      );
      const taken: Record<NodeId, unknown> = { ...diagram.nodes };
      const copy = withFreshIds(fragmentOf(diagram, [id]), (own) => freshId({ ...taken, ...own }, random));
      return insertFragment(
        copy,
        parent === undefined ? { at: 'draft' } : { at: 'child', parent, index: which % 4 },
      );
    }
    case 10:
      return moveNode(id, { at: 'draft', position: [which % 500, where % 500] });
    case 11:
      return (
        [setName(id, `name ${which}`), setPort(id, 'p', `{k${which}}`), setComment(id, 'c'), tidy()][
          which % 4
        ] ?? null
      );
    default:
      return which % 2 === 0 ? setDisabled([id], true) : setCollapsed(id, which % 3 === 0);
  }
}

export const steps = fc.array(fc.tuple(fc.nat(1000), fc.nat(1000), fc.nat(1000)), { maxLength: 60 });

/** Returns the reason why a diagram is not a valid forest; null if it is valid. For tests. */
export function illegality(diagram: Diagram): string | null {
  const seen = new Set<NodeId>();
  const open = [...topsOf(diagram)];
  for (let id = open.pop(); id !== undefined; id = open.pop()) {
    if (seen.has(id)) return `${id} hangs twice`;
    seen.add(id);
    const node = diagram.nodes[id];
    if (!node) return `${id} is not there`;
    const count = childrenOf(diagram, id).length;
    const max = vocabulary.specs.get(node.type)?.maxChildren ?? 0;
    if (count > max) return `${node.type} has ${count} children, and may have ${max}`;
    open.push(...childrenOf(diagram, id));
  }
  const lost = Object.keys(diagram.nodes).filter((id) => !seen.has(id));
  return lost.length > 0 ? `${lost.join()} hang nowhere` : null;
}
