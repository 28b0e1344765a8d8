import catalog from '@catalog';
import { memo, useMemo } from 'react';
import { parseDiagram } from '@/model/serialize';
import { childrenOf, type Diagram } from '@/model/diagram';
import { layoutTree, type Box, type Layout } from '@/model/layout';
import { makeVocabulary, readCatalog, specOf } from '@/model/vocabulary';
import classes from './projects.module.css';

interface TreePictureProps {
  readonly diagram: unknown;
}

const vocabulary = makeVocabulary(readCatalog(catalog));
const MARGIN = 16;

interface Picture {
  diagram: Diagram;
  layout: Layout;
}

function read(document: unknown): Picture | null {
  try {
    const diagram = parseDiagram(document);
    const layout = layoutTree(diagram, vocabulary, { ignorePositions: true });
    return layout.width > 0 ? { diagram, layout } : null;
  } catch {
    // The diagram's error is reported when the project is opened; here its card has no picture.
    return null;
  }
}

function edgePath(from: Box, to: Box, isVertical: boolean): string {
  const start = isVertical
    ? [from.x + from.width / 2, from.y + from.height]
    : [from.x + from.width, from.y + from.height / 2];
  const end = isVertical ? [to.x + to.width / 2, to.y] : [to.x, to.y + to.height / 2];
  const [x1 = 0, y1 = 0] = start;
  const [x2 = 0, y2 = 0] = end;
  const middle = isVertical ? (y1 + y2) / 2 : (x1 + x2) / 2;
  return isVertical
    ? `M${x1} ${y1}C${x1} ${middle} ${x2} ${middle} ${x2} ${y2}`
    : `M${x1} ${y1}C${middle} ${y1} ${middle} ${y2} ${x2} ${y2}`;
}

/** A small picture of a tree: shapes and colours only. */
export const TreePicture = memo(function TreePicture({ diagram: document }: TreePictureProps) {
  const picture = useMemo(() => read(document), [document]);
  if (!picture) return <div className={classes['noPicture']} aria-hidden="true" />;
  const { diagram, layout } = picture;
  const boxes = Object.entries(layout.positions);
  const left = Math.min(...boxes.map(([, box]) => box.x)) - MARGIN;
  const top = Math.min(...boxes.map(([, box]) => box.y)) - MARGIN;
  const right = Math.max(...boxes.map(([, box]) => box.x + box.width)) + MARGIN;
  const bottom = Math.max(...boxes.map(([, box]) => box.y + box.height)) + MARGIN;
  return (
    <svg
      className={classes['picture']}
      viewBox={`${left} ${top} ${right - left} ${bottom - top}`}
      aria-hidden="true"
      preserveAspectRatio="xMidYMid meet"
    >
      {boxes.flatMap(([id, box]) =>
        childrenOf(diagram, id).map((child) => {
          const to = layout.positions[child];
          return to ? (
            <path
              key={`${id}-${child}`}
              d={edgePath(box, to, diagram.layout === 'vertical')}
              className={classes['pictureEdge']}
            />
          ) : null;
        }),
      )}
      {boxes.map(([id, box]) => {
        const node = diagram.nodes[id];
        const family = node ? (specOf(vocabulary, node)?.family ?? 'action') : 'action';
        return (
          <rect
            key={id}
            x={box.x}
            y={box.y}
            width={box.width}
            height={box.height}
            rx={family === 'condition' ? box.height / 2 : 10}
            fill={`var(--bts-${family})`}
          />
        );
      })}
    </svg>
  );
});
