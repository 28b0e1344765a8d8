import { IconAlertTriangle, IconSearch } from '@tabler/icons-react';
import { memo, type CSSProperties } from 'react';
import type { ChangeKind } from '@/model/difference/changes';
import { displayName, type NodeId } from '@/model/diagram';
import type { Box } from '@/model/layout';
import type { Part } from '@/model/nested';
import { NodeSymbol } from '@/ui/NodeSymbol';
import type { Facts, FactsOf } from './facts';
import classes from './WholeTree.module.css';

interface Props {
  readonly part: Part;
  readonly fact: Facts;
  readonly facts: FactsOf;
  readonly mark: ChangeKind | undefined;
  readonly hits: ReadonlySet<NodeId>;
  /** Whether nothing is below it. */
  readonly isLeaf: boolean;
}

/** From this width on a box has room for the symbol of its block, in px. */
const SYMBOL_FROM = 64;
/** From this height on a name is written large, in px. */
const LARGE = 18;

const place = ({ x, y, width, height }: Box, within: { x: number; y: number } = { x: 0, y: 0 }) => ({
  left: x - within.x,
  top: y - within.y,
  width,
  height,
});

/** A block of the whole tree with its name, around its children's boxes or around all below it as one piece. */
export const PartBox = memo(function PartBox({ part, fact, facts, mark, hits, isLeaf }: Props) {
  const { id, box, title, level, piece } = part;
  const { node, family, hasError, isSelected } = fact;
  const count = piece?.blocks.length ?? 0;
  const found = piece?.blocks.filter((each) => hits.has(each)).length ?? 0;
  const hasErrorBelow = piece?.blocks.some((each) => facts.get(each)?.hasError) ?? false;
  const isChosenBelow = piece?.blocks.some((each) => facts.get(each)?.isSelected) ?? false;
  const name = displayName(node);
  const color: CSSProperties = node.color ? { ['--family' as string]: node.color } : {};
  return (
    <div
      role="treeitem"
      aria-level={level}
      aria-selected={isSelected}
      className={`${classes['part']} ${isLeaf ? classes['leaf'] : ''}`}
      data-part={id}
      data-family={family ?? 'unknown'}
      data-mark={mark}
      data-found={hits.has(id) || undefined}
      data-chosen={isSelected || undefined}
      data-disabled={node.disabled || undefined}
      style={{ ...place(box), ...color, ['--title' as string]: `${title}px` }}
    >
      <div className={classes['title']} data-large={title >= LARGE || undefined}>
        {box.width >= SYMBOL_FROM && (
          <span className={classes['symbol']}>
            <NodeSymbol type={node.type} family={family} size={title >= LARGE ? 14 : 11} />
          </span>
        )}
        <span className={classes['name']}>{name}</span>
        {(hasError || hasErrorBelow) && (
          <IconAlertTriangle className={classes['error'] ?? ''} size={12} aria-hidden="true" />
        )}
        {found > 0 && (
          <span className={classes['found']}>
            <IconSearch size={9} stroke={3} aria-hidden="true" />
            {found}
          </span>
        )}
        <span className={classes['mark']} data-mark-of={id} aria-hidden="true" />
        {count > 0 && <span className={classes['count']}>{count}</span>}
      </div>
      {piece && (
        <div
          className={classes['piece']}
          data-piece={count}
          data-found={found || undefined}
          data-chosen={isChosenBelow || undefined}
          style={place(piece.box, box)}
        />
      )}
    </div>
  );
});
